// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/plugin_library.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace farop {
namespace {

namespace fs = std::filesystem;

farop_status nothing_self(void*) {
  return FAROP_OK;
}

farop_rasterizer sound_table() {
  farop_rasterizer table{};
  table.struct_size = sizeof table;
  table.abi_version = FAROP_ABI_VERSION;
  table.name = "sound-1_0";
  table.summary = "a \x1b[31mred\x1b[0m line\nand another";
  table.begin_frame = [](void*, const farop_frame*) -> farop_status { return FAROP_OK; };
  table.polygon = [](void*, const farop_polygon*) -> farop_status { return FAROP_OK; };
  table.end_frame = nothing_self;
  return table;
}

TEST(PluginTable, OfThisVersionOrALaterMinorOneIsTaken) {
  farop_rasterizer table = sound_table();
  const PluginLibrary library = check_plugin_table(&table);
  EXPECT_EQ(library.failure, LoadFailure::none);
  EXPECT_EQ(library.table, &table);
  EXPECT_EQ(library.name, "sound-1_0");
  EXPECT_EQ(library.summary.find('\x1b'), std::string::npos);
  EXPECT_EQ(library.summary.find('\n'), std::string::npos);
  table.struct_size += 64;  // grown by a later minor version
  table.abi_version += 7;
  EXPECT_EQ(check_plugin_table(&table).failure, LoadFailure::none);
}

TEST(PluginTable, IsRefusedInWordsThatSayWhy) {
  const auto refusal = [](auto change) {
    farop_rasterizer table = sound_table();
    change(table);
    return check_plugin_table(&table);
  };
  const PluginLibrary other_major = refusal([](auto& t) { t.abi_version = 0x20003; });
  EXPECT_EQ(other_major.failure, LoadFailure::version);
  EXPECT_EQ(other_major.message, "built for rasterizer interface 2.3, this farop speaks 1.x");
  EXPECT_EQ(other_major.table, nullptr);
  const auto message = [&](auto change) {
    const PluginLibrary library = refusal(change);
    EXPECT_EQ(library.failure, LoadFailure::contract);
    return library.message;
  };
  EXPECT_EQ(message([](auto& t) { t.struct_size = 64; }), "its table has struct_size 64, version 1.0 has 72");
  EXPECT_EQ(message([](auto& t) { t.begin_frame = nullptr; }), "its table has no begin_frame");
  EXPECT_EQ(message([](auto& t) { t.polygon = nullptr; }), "its table has no polygon");
  EXPECT_EQ(message([](auto& t) { t.end_frame = nullptr; }), "its table has no end_frame");
  EXPECT_EQ(message([](auto& t) { t.wants = 1u << 9; }),
            "it wants something that this farop does not know (bits 0x200)");
  const std::string names = "is not 1 to 64 of the characters a-z 0-9 _ -";
  static const std::string endless(100000, 'a');
  for (const char* name :
       {static_cast<const char*>(nullptr), "", "Capital", "a b", "\"><img onerror>", endless.c_str()}) {
    EXPECT_NE(message([&](auto& t) { t.name = name; }).find(names), std::string::npos);
  }
  EXPECT_EQ(check_plugin_table(nullptr).failure, LoadFailure::refused);
}

class PluginFiles : public testing::Test {
 protected:
  PluginFiles() {
    std::string name = (fs::temp_directory_path() / "farop-plugin-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~PluginFiles() override { fs::remove_all(folder_); }
  std::string write(const std::string& bytes) {
    const fs::path path = folder_ / "file.so";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  fs::path folder_;
};

std::string self_bytes(std::size_t count) {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  std::string bytes(count, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  return bytes;
}

TEST_F(PluginFiles, AreLookedAtWithoutRunningThem) {
  const auto message = [](const std::string& path) {
    const PluginLibrary library = inspect_plugin_file(path);
    EXPECT_EQ(library.failure, LoadFailure::file);
    return library.message;
  };
  EXPECT_EQ(message(folder_ / "missing.so"), "cannot be opened: No such file or directory");
  EXPECT_EQ(message(folder_), "is a folder, expected a shared library (.so)");
  EXPECT_EQ(message("/dev/zero"), "is no regular file, expected a shared library (.so)");
  EXPECT_EQ(message(write("")), "is not a shared library (no ELF file)");
  EXPECT_EQ(message(write("int main() {}\n and more text of a source file")),
            "is not a shared library (no ELF file)");
  EXPECT_EQ(message(write(self_bytes(20))), "is cut short");
  std::string header = self_bytes(64);
  EXPECT_EQ(message(write(header)), "is cut short: its headers lie behind its end");
  header.replace(32, 8, 8, '\xFF');  // so far behind that their end comes round to the file's start
  EXPECT_EQ(message(write(header)), "is cut short: its headers lie behind its end");
  header[4] = 1;
  EXPECT_EQ(message(write(header)), "is a 32-bit file, this farop is a 64-bit program");
  header[4] = 2, header[18] = 3;
  EXPECT_NE(message(write(header)).find("is built for another machine"), std::string::npos);
  header = self_bytes(64), header[16] = 1;
  EXPECT_NE(message(write(header)).find("is not a shared library (an executable or an object file)"),
            std::string::npos);
}

}  // namespace
}  // namespace farop

// SPDX-License-Identifier: GPL-3.0-or-later
#include "unit/isolate/hostile_rows.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <ostream>
#include <set>
#include <sstream>

namespace farop::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_canary_text = "results of somebody else";

std::string canary_name() {
  return "farop-canary-" + suite();
}

std::set<int> marked_processes() {
  std::set<int> found;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "comm");
    std::string name;
    if (std::getline(file, name) && name == "hostile-" + suite())
      found.insert(std::atoi(entry.path().filename().c_str()));
  }
  return found;
}

}  // namespace

int Row::number() const {
  return std::atoi(name.c_str());
}

bool Row::needs_check() const {
  static const std::set<std::string> rows = {"21-uninitialised-depth",
                                             "22a-rand-in-fill-rule",
                                             "22b-time-dependent-colours",
                                             "23-state-between-frames",
                                             "24b-race",
                                             "54-recognises-scenes",
                                             "55-evades"};
  return rows.contains(name);
}

std::ostream& operator<<(std::ostream& out, const Row& row) {
  return out << row.name;
}

std::vector<Row> rows_of(const std::string& manifest) {
  std::vector<Row> rows;
  std::ifstream file(manifest);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    Row row;
    std::string also;
    std::getline(fields, row.name, '\t');
    std::getline(fields, row.expected, '\t');
    std::getline(fields, also, '\t');
    std::getline(fields, row.path, '\t');
    std::istringstream words(also);
    for (std::string word; std::getline(words, word, ',');) row.also.push_back(word);
    rows.push_back(row);
  }
  return rows;
}

std::vector<Row> built_rows() {
  return rows_of(std::string(FAROP_HOSTILE) + "/manifest.txt");
}

std::string test_name(const Row& row) {
  std::string name = row.name;
  std::ranges::replace_if(
      name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

const std::string& suite() {
  static const std::string id = fmt::format("{:x}", ::getpid());
  return id;
}

Surroundings::Surroundings() {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  for (const char* folder : {"/tmp", "/var/tmp", "/dev/shm", "."}) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) continue;
    std::ofstream(fs::path(folder) / canary_name()) << k_canary_text << '\n';
    folders_.emplace_back(folder);
  }
  before_ = belongings();
}

Surroundings::~Surroundings() {
  std::error_code error;
  for (const fs::path& folder : folders_) fs::remove(folder / canary_name(), error);
}

void Surroundings::expect_unchanged(const std::string& what) const {
  for (const fs::path& folder : folders_) {
    std::ifstream file(folder / canary_name());
    std::string line;
    EXPECT_TRUE(std::getline(file, line) && line == k_canary_text) << what << ": " << folder;
    for (const char* made : {"-2", "-fill"})
      EXPECT_FALSE(fs::exists(folder / (canary_name() + made))) << what << ": " << folder << made;
  }
  EXPECT_TRUE(marked_processes().empty()) << what;
  EXPECT_TRUE(processes_running(own_runner()).empty()) << what;
  const Belongings after = belongings();
  EXPECT_EQ(before_.descriptors, after.descriptors) << what;
  EXPECT_EQ(before_.children, after.children) << what;
  EXPECT_EQ(before_.memories, after.memories) << what;
}

}  // namespace farop::test

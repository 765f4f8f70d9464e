// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shell.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace farop::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "farop-test-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ec;
  fs::remove_all(path_, ec);
}

namespace {

Outcome run_script(const TemporaryFolder& folder, const std::string& command, const char* more_options) {
  const TemporaryFolder streams;
  const fs::path script = streams / "script", out = streams / "out", err = streams / "err";
  // A sanitizer report must fail a test, whatever status the test expects.
  write_file(script, std::string("set -o pipefail\nunset ${!FAROP_@}\nexport ASAN_OPTIONS=exitcode=99") +
                         more_options +
                         " UBSAN_OPTIONS=exitcode=99\nexport PATH='" FAROP_PROGRAM_FOLDER "':$PATH\n" +
                         command + "\n");
  const std::string line = "cd '" + folder.path().string() + "' && timeout -k 5 120 bash '" +
                           script.string() + "' > '" + out.string() + "' 2> '" + err.string() +
                           "' < /dev/null";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(out), read_file(err)};
}

}  // namespace

Outcome shell(const TemporaryFolder& folder, const std::string& command) {
  Outcome outcome = run_script(folder, command, "");
  // The leak checker itself sometimes crashes on threads that are just ending (those of picture libraries):
  // no finding, so the command is run again without it.
  if (outcome.err.find("LeakSanitizer has encountered a fatal error") != std::string::npos)
    outcome = run_script(folder, command, ":detect_leaks=0");
  return outcome;
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
}

}  // namespace farop::test

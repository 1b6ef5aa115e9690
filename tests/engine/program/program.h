// Runs the program as its users do.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

namespace tessera {

struct Result {
  int code = -1;
  std::string out;
  std::string err;
};

/// Runs TESSERA_PROGRAM in a temporary folder.
class Program : public testing::Test {
 protected:
  Program()
      : folder_(std::filesystem::temp_directory_path() / ("tessera_program_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Program() override { std::filesystem::remove_all(folder_); }

  Result run(const std::string& arguments) const {
    const int code = code_of(arguments, "out.txt");
    return {code, content("out.txt"), content("err.txt")};
  }
  /// Returns whether run_without_room() works on this system.
  static bool has_full_disk() { return std::filesystem::is_character_file("/dev/full"); }
  /// Runs the program with its standard output on a full disk.
  Result run_without_room(const std::string& arguments) const {
    const int code = code_of(arguments, "/dev/full");
    return {code, "", content("err.txt")};
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string content(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  std::filesystem::path folder_;

 private:
  int code_of(const std::string& arguments, const std::string& out) const {
    const std::string command =
        "cd '" + folder_.string() + "' && '" TESSERA_PROGRAM "' " + arguments + " >" + out + " 2>err.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace tessera

// A temporary folder of OBJ and MTL files.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "engine/program/import/model.h"

namespace tessera {

class ObjFolder : public testing::Test {
 protected:
  ObjFolder()
      : folder_(std::filesystem::temp_directory_path() / ("tessera_obj_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ObjFolder() override { std::filesystem::remove_all(folder_); }

  /// Returns the path of the file.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  program::Model mesh_of(const std::string& obj) const { return program::import_model(write("m.obj", obj)); }
  program::Model shown(const std::string& obj) const {
    return program::import_model(write("m.obj", obj), program::ModelUse::display);
  }
  /// A triangle of each material of m.mtl that is named, for display.
  program::Model shown_with(const std::string& mtl, const std::vector<std::string>& materials = {"a"}) const {
    write("m.mtl", mtl);
    std::string obj = std::string("mtllib m.mtl\n") + kTriangle + "vt 0 0\nvt 1 0\nvt 0 1\n";
    for (const std::string& material : materials) obj += "usemtl " + material + "\nf 1/1 2/2 3/3\n";
    return shown(obj);
  }
  std::string message_of(const std::string& obj) const {
    const std::string path = write("bad.obj", obj);
    try {
      program::import_model(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "(no error)";
  }

  static constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  std::filesystem::path folder_;
};

}  // namespace tessera

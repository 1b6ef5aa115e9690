// A temporary folder of 3MF packages.
#pragma once

#include <gtest/gtest.h>
#include <zip.h>

#include <filesystem>
#include <map>
#include <string>

#include <unistd.h>

#include "engine/program/import/model.h"

namespace tessera {

class ThreemfFolder : public testing::Test {
 protected:
  ThreemfFolder()
      : folder_(std::filesystem::temp_directory_path() / ("tessera_3mf_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ThreemfFolder() override { std::filesystem::remove_all(folder_); }

  /// Writes an archive of these files and returns its path.
  std::string write_archive(const std::map<std::string, std::string>& files) const {
    const std::string path = (folder_ / "m.3mf").string();
    const zipFile archive = zipOpen64(path.c_str(), APPEND_STATUS_CREATE);
    for (const auto& [name, bytes] : files) {
      EXPECT_EQ(zipOpenNewFileInZip64(archive, name.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr,
                                      Z_DEFLATED, Z_DEFAULT_COMPRESSION, 0),
                ZIP_OK);
      zipWriteInFileInZip(archive, bytes.data(), static_cast<unsigned>(bytes.size()));
      zipCloseFileInZip(archive);
    }
    EXPECT_EQ(zipClose(archive, nullptr), ZIP_OK);
    return path;
  }

  /// Writes a package of a model part with these resources and items, and further files.
  std::string write_package(const std::string& resources, const std::string& items,
                            std::map<std::string, std::string> files = {},
                            const std::string& attributes = "") const {
    files["_rels/.rels"] = kRelationships;
    files["3D/m.model"] = "<?xml version=\"1.0\"?><model " + attributes + "><resources>" + resources +
                          "</resources><build>" + items + "</build></model>";
    return write_archive(files);
  }

  program::Model model_of(const std::string& resources, const std::string& items = kItem,
                          const std::map<std::string, std::string>& files = {}) const {
    return program::import_model(write_package(resources, items, files), program::ModelUse::display);
  }

  static std::string message_of(const std::string& path) {
    try {
      program::import_model(path, program::ModelUse::display);
    } catch (const Error& error) {
      return error.what();
    }
    return "(no error)";
  }

  /// An object of one triangle in the plane z = 0, with its right angle at the origin.
  static std::string triangle(const std::string& object_attributes, const std::string& attributes = "") {
    return "<object " + object_attributes +
           "><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
           "<vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\" " +
           attributes + "/></triangles></mesh></object>";
  }

  static constexpr const char* kItem = "<item objectid=\"1\"/>";
  static constexpr const char* kRelationships =
      "<Relationships><Relationship Target=\"/Metadata/t.png\" Type=\"thumbnail\"/><Relationship "
      "Target=\"/3D/m.model\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  std::filesystem::path folder_;
};

}  // namespace tessera

// tinygltf as this project uses it: structures only. The macros change its classes, so that every file
// includes it through this one.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON

#include <fstream>

#include <nlohmann/json.hpp>

#include <tiny_gltf.h>

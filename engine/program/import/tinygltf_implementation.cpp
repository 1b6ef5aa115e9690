// The implementation of tinygltf. Files and images are read by gltf_file.cpp.
#define TINYGLTF_IMPLEMENTATION
#include "engine/program/import/tinygltf_include.h"

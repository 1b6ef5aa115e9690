// The one place that compiles the header-only OBJ loader, with coordinates as doubles (see load_mesh.cpp).
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

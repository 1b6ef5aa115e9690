# The reference renderer, an oracle of the tests; tessera-accuracy measures errors against it.
include_guard()

find_package(nlohmann_json 3.9 CONFIG REQUIRED)
find_path(TESSERA_TINYOBJ_INCLUDE tiny_obj_loader.h REQUIRED)
mark_as_advanced(TESSERA_TINYOBJ_INCLUDE)

file(GLOB reference_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
add_library(tessera_reference STATIC ${reference_sources})
target_link_libraries(tessera_reference PRIVATE tessera_options PUBLIC nlohmann_json::nlohmann_json)
target_include_directories(tessera_reference PUBLIC ${PROJECT_SOURCE_DIR})
target_include_directories(tessera_reference SYSTEM PRIVATE ${TESSERA_TINYOBJ_INCLUDE})
target_compile_definitions(tessera_reference PRIVATE
  TESSERA_TEAPOT_PATCHES="${PROJECT_SOURCE_DIR}/engine/program/scenes/teapot_patches.txt")
target_compile_options(tessera_reference PRIVATE -O2)  # scalar double precision: too slow without optimization, also in sanitizer builds

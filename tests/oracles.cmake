# Oracles of the tests and rivals of the benchmarks: the reference renderer, and Mesa if OSMesa is installed.
include_guard()

find_package(nlohmann_json 3.9 CONFIG REQUIRED)
find_path(TESSERA_TINYOBJ_INCLUDE tiny_obj_loader.h REQUIRED)
mark_as_advanced(TESSERA_TINYOBJ_INCLUDE)

file(GLOB reference_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/reference/*.cpp)
if(reference_sources)
  add_library(tessera_reference STATIC ${reference_sources})
  target_link_libraries(tessera_reference PRIVATE tessera_options PUBLIC nlohmann_json::nlohmann_json)
  target_include_directories(tessera_reference PUBLIC ${PROJECT_SOURCE_DIR})
  target_include_directories(tessera_reference SYSTEM PRIVATE ${TESSERA_TINYOBJ_INCLUDE})
  target_compile_definitions(tessera_reference PRIVATE
    TESSERA_TEAPOT_PATCHES="${PROJECT_SOURCE_DIR}/engine/program/scenes/teapot_patches.txt")
  target_compile_options(tessera_reference PRIVATE -O2)  # scalar double precision: too slow without optimization, also in sanitizer builds
endif()

find_path(TESSERA_OSMESA_INCLUDE GL/osmesa.h)
find_library(TESSERA_OSMESA_LIBRARY OSMesa)
mark_as_advanced(TESSERA_OSMESA_INCLUDE TESSERA_OSMESA_LIBRARY)
file(GLOB mesa_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/mesa/*.cpp)
if(NOT TESSERA_OSMESA_INCLUDE OR NOT TESSERA_OSMESA_LIBRARY)
  message(STATUS "OSMesa not found (Debian: libosmesa6-dev): no picture tests, no benchmarks")
elseif(mesa_sources AND TARGET tessera_reference)
  add_library(tessera_mesa STATIC ${mesa_sources})
  target_link_libraries(tessera_mesa PRIVATE tessera_options PUBLIC tessera_reference ${TESSERA_OSMESA_LIBRARY})
  target_include_directories(tessera_mesa SYSTEM PUBLIC ${TESSERA_OSMESA_INCLUDE})
endif()

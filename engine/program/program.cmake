# Everything above the core: scene files, models, image files, the program.
#   tessera_scene    static library: scene, import, built-in meshes, image writing; link tessera (or its objects) beside it
#   tessera_imageio  module that OpenImageIO hides in, loaded at run time
#   tessera_import   module that assimp hides in, loaded by the child process that reads a model
#   tessera_cli      the program bin/tessera
find_package(nlohmann_json 3.11 CONFIG REQUIRED)
find_package(tinyobjloader CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(PNG REQUIRED)
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET "OpenImageIO>=2.4" Imath)  # Debian's CMake package of OpenImageIO is broken

set(tessera_embedded ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp)
add_custom_command(OUTPUT ${tessera_embedded}
  COMMAND ${CMAKE_COMMAND} -DTEAPOT=${CMAKE_CURRENT_SOURCE_DIR}/engine/program/scenes/teapot_patches.txt
          -DSCENE=${CMAKE_CURRENT_SOURCE_DIR}/engine/program/scenes/shiny_teapot.json -DOUTPUT=${tessera_embedded}
          -P ${CMAKE_CURRENT_SOURCE_DIR}/engine/program/scene/embed.cmake
  DEPENDS engine/program/scene/embed.cmake engine/program/scenes/teapot_patches.txt engine/program/scenes/shiny_teapot.json
  COMMENT "Embedding the teapot and the built-in scene" VERBATIM)

file(GLOB tessera_scene_sources CONFIGURE_DEPENDS engine/program/scene/*.cpp engine/program/import/*.cpp engine/program/imageio/*.cpp engine/program/threads/*.cpp)
set(tessera_import_sources engine/program/import/import_module.cpp engine/program/import/assimp_material.cpp engine/program/import/assimp_model.cpp engine/program/import/assimp_view.cpp engine/program/import/gltf_view.cpp)
list(TRANSFORM tessera_import_sources PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
list(REMOVE_ITEM tessera_scene_sources ${tessera_import_sources} ${CMAKE_CURRENT_SOURCE_DIR}/engine/program/imageio/module.cpp ${CMAKE_CURRENT_SOURCE_DIR}/engine/program/imageio/indexed_png.cpp)
add_library(tessera_scene STATIC ${tessera_scene_sources} ${tessera_embedded})
target_compile_definitions(tessera_scene PRIVATE TESSERA_SOVERSION="${tessera_soversion}")  # of the modules
target_include_directories(tessera_scene INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(tessera_scene PRIVATE tessera_options TBB::tbb nlohmann_json::nlohmann_json tinyobjloader::tinyobjloader ${CMAKE_DL_LIBS})

add_library(tessera_imageio SHARED engine/program/imageio/module.cpp engine/program/imageio/indexed_png.cpp)
target_link_libraries(tessera_imageio PRIVATE tessera_options PkgConfig::OIIO PNG::PNG)
set_target_properties(tessera_imageio PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${tessera_soversion})

find_package(assimp CONFIG REQUIRED)
add_library(tessera_import SHARED ${tessera_import_sources} engine/program/import/model_bytes.cpp engine/program/import/model_normals.cpp)
target_link_libraries(tessera_import PRIVATE tessera_options tessera assimp::assimp nlohmann_json::nlohmann_json)
set_target_properties(tessera_import PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${tessera_soversion})

set(tessera_selftest ${CMAKE_CURRENT_BINARY_DIR}/selftest_scenes.cpp)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/engine/program/cli/selftest_scenes.txt)
file(STRINGS engine/program/cli/selftest_scenes.txt tessera_selftest_files)
list(TRANSFORM tessera_selftest_files REPLACE " .*" ".json")
list(TRANSFORM tessera_selftest_files PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/tests/scenes/)
foreach(file ${tessera_selftest_files})
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "engine/program/cli/selftest_scenes.txt names a scene that there is none of: ${file}")
  endif()
endforeach()
add_custom_command(OUTPUT ${tessera_selftest}
  COMMAND ${CMAKE_COMMAND} -DLIST=${CMAKE_CURRENT_SOURCE_DIR}/engine/program/cli/selftest_scenes.txt -DSCENES=${CMAKE_CURRENT_SOURCE_DIR}/tests/scenes
          -DHASHES=${CMAKE_CURRENT_SOURCE_DIR}/tests/picture_hashes.txt -DOUTPUT=${tessera_selftest} -P ${CMAKE_CURRENT_SOURCE_DIR}/engine/program/cli/embed_selftest.cmake
  DEPENDS engine/program/cli/embed_selftest.cmake engine/program/cli/selftest_scenes.txt tests/picture_hashes.txt ${tessera_selftest_files}
  COMMENT "Embedding the scenes of the self-test" VERBATIM)

file(GLOB tessera_cli_sources CONFIGURE_DEPENDS engine/program/cli/*.cpp)
add_executable(tessera_cli ${tessera_cli_sources} ${tessera_selftest})
target_link_libraries(tessera_cli PRIVATE tessera_options tessera_scene tessera CLI11::CLI11 nlohmann_json::nlohmann_json TBB::tbb)
set_target_properties(tessera_cli PROPERTIES OUTPUT_NAME tessera INSTALL_RPATH "$ORIGIN/../lib")
add_dependencies(tessera_cli tessera_imageio tessera_import)

# The program: scene files, models, image files and the command line.
#   tessera_scene    static library: scenes, import, built-in meshes, image files, comparison of pictures. Its
#                    users also link tessera or tessera's objects.
#   tessera_imageio  module that contains OpenImageIO; loaded at run time
#   tessera_import   module that contains assimp and the reader of 3MF; loaded by the child process that reads a
#                    model
#   tessera_cli      the program bin/tessera
find_package(nlohmann_json 3.11 CONFIG REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED)
pkg_check_modules(DRACO REQUIRED IMPORTED_TARGET draco)
find_path(TESSERA_TINYGLTF_INCLUDE tiny_gltf.h REQUIRED)  # the header alone: its CMake target links an implementation with image readers
find_package(CLI11 CONFIG REQUIRED)
pkg_check_modules(DEFLATE REQUIRED IMPORTED_TARGET libdeflate)  # compression of PNG files
# Debian's CMake package of OpenImageIO is broken.
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET "OpenImageIO>=2.4" Imath)

set(program_dir ${CMAKE_CURRENT_SOURCE_DIR}/engine/program)

set(teapot ${program_dir}/scenes/teapot_patches.txt)
set(builtin_scene ${program_dir}/scenes/shiny_teapot.json)
set(tessera_embedded ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp)
add_custom_command(OUTPUT ${tessera_embedded}
  COMMAND ${CMAKE_COMMAND} -DTEAPOT=${teapot} -DSCENE=${builtin_scene} -DOUTPUT=${tessera_embedded}
          -P ${program_dir}/scene/embed.cmake
  DEPENDS ${program_dir}/scene/embed.cmake ${teapot} ${builtin_scene}
  COMMENT "Embedding the teapot and the built-in scene" VERBATIM)

file(GLOB tessera_scene_sources CONFIGURE_DEPENDS
  ${program_dir}/scene/*.cpp ${program_dir}/import/*.cpp ${program_dir}/imageio/*.cpp
  ${program_dir}/compare/*.cpp ${program_dir}/threads/*.cpp)
set(tessera_imageio_sources ${program_dir}/imageio/module.cpp)
set(tessera_import_sources
  import_module.cpp assimp_material.cpp assimp_model.cpp assimp_view.cpp threemf.cpp threemf_package.cpp
  threemf_resources.cpp threemf_xml.cpp)
list(TRANSFORM tessera_import_sources PREPEND ${program_dir}/import/)
list(REMOVE_ITEM tessera_scene_sources ${tessera_import_sources} ${tessera_imageio_sources})
add_library(tessera_scene STATIC ${tessera_scene_sources} ${tessera_embedded})
target_compile_definitions(tessera_scene PRIVATE TESSERA_SOVERSION="${tessera_soversion}")  # of the modules
target_include_directories(tessera_scene INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
set_source_files_properties(${program_dir}/import/tinygltf_implementation.cpp PROPERTIES
  SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS -w)  # a library's code
target_link_libraries(tessera_scene PRIVATE
  tessera_options TBB::tbb nlohmann_json::nlohmann_json
  meshoptimizer::meshoptimizer PkgConfig::DRACO PkgConfig::DEFLATE ${CMAKE_DL_LIBS})


add_library(tessera_imageio SHARED ${tessera_imageio_sources})
target_link_libraries(tessera_imageio PRIVATE tessera_options PkgConfig::OIIO)
set_target_properties(tessera_imageio PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${tessera_soversion})

find_package(assimp CONFIG REQUIRED)
pkg_check_modules(MINIZIP REQUIRED IMPORTED_TARGET minizip)  # archives and XML of 3MF
find_package(pugixml CONFIG REQUIRED)
add_library(tessera_import SHARED
  ${tessera_import_sources} ${program_dir}/import/model_bytes.cpp ${program_dir}/import/model_normals.cpp
  ${program_dir}/import/model_origin.cpp)
target_link_libraries(tessera_import PRIVATE
  tessera_options tessera assimp::assimp nlohmann_json::nlohmann_json PkgConfig::MINIZIP pugixml::pugixml)
set_target_properties(tessera_import PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${tessera_soversion})

set(tessera_selftest ${CMAKE_CURRENT_BINARY_DIR}/selftest_scenes.cpp)
set(selftest_list ${program_dir}/cli/selftest_scenes.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${selftest_list})
file(STRINGS ${selftest_list} selftest_files)
list(TRANSFORM selftest_files REPLACE " .*" ".json")
list(TRANSFORM selftest_files PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/tests/scenes/)
foreach(file ${selftest_files})
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "${selftest_list} names a scene that does not exist: ${file}")
  endif()
endforeach()
set(selftest_hashes ${CMAKE_CURRENT_SOURCE_DIR}/tests/picture_hashes.txt)
add_custom_command(OUTPUT ${tessera_selftest}
  COMMAND ${CMAKE_COMMAND} -DLIST=${selftest_list} -DSCENES=${CMAKE_CURRENT_SOURCE_DIR}/tests/scenes
          -DHASHES=${selftest_hashes} -DOUTPUT=${tessera_selftest} -P ${program_dir}/cli/embed_selftest.cmake
  DEPENDS ${program_dir}/cli/embed_selftest.cmake ${selftest_list} ${selftest_hashes} ${selftest_files}
  COMMENT "Embedding the scenes of the self-test" VERBATIM)

set(tessera_gallery ${CMAKE_CURRENT_BINARY_DIR}/gallery_files.cpp)
file(GLOB gallery_files CONFIGURE_DEPENDS ${program_dir}/gallery/*)
add_custom_command(OUTPUT ${tessera_gallery}
  COMMAND ${CMAKE_COMMAND} -DFOLDER=${program_dir}/gallery -DOUTPUT=${tessera_gallery} -P ${program_dir}/cli/embed_gallery.cmake
  DEPENDS ${program_dir}/cli/embed_gallery.cmake ${gallery_files}
  COMMENT "Embedding the gallery" VERBATIM)

# Command lines of tessera, tessera-bench and tessera-accuracy.
set(tessera_command_line_sources command_docs.cpp command_line.cpp given_options.cpp help_text.cpp validators.cpp)
list(TRANSFORM tessera_command_line_sources PREPEND ${program_dir}/cli/)
add_library(tessera_command_line STATIC ${tessera_command_line_sources})
target_link_libraries(tessera_command_line PUBLIC tessera_options CLI11::CLI11 nlohmann_json::nlohmann_json)
target_compile_options(tessera_command_line PRIVATE $<$<CONFIG:Release>:-O1>)
file(GLOB tessera_cli_sources CONFIGURE_DEPENDS ${program_dir}/cli/*.cpp)
list(REMOVE_ITEM tessera_cli_sources ${tessera_command_line_sources})
add_executable(tessera_cli ${tessera_cli_sources} ${tessera_selftest} ${tessera_gallery})
target_link_libraries(tessera_cli PRIVATE tessera_command_line tessera_scene tessera tessera_display TBB::tbb)
target_compile_options(tessera_cli PRIVATE $<$<CONFIG:Release>:-O1>)  # a third less compile time; draws nothing itself
set_target_properties(tessera_cli PROPERTIES OUTPUT_NAME tessera INSTALL_RPATH "$ORIGIN/../lib")
add_dependencies(tessera_cli tessera_imageio tessera_import)

# Fuzz targets, one program each. The preset `fuzz` (clang) links libFuzzer and the address and undefined
# sanitizers:
#
#   cmake --preset fuzz && cmake --build --preset fuzz
#   # Fuzz; new inputs go into FOLDER.
#   build/fuzz/bin/fuzz_scene -dict=tests/fuzz/scene.dict -max_len=4096 FOLDER tests/fuzz/corpus/scene
#   # Run one input.
#   build/fuzz/bin/fuzz_scene crash-0123...
#   # Minimize: the fewest inputs with the same coverage go into NEW.
#   build/fuzz/bin/fuzz_scene -merge=1 -max_len=4096 NEW FOLDER tests/fuzz/corpus/scene
#
# Every other build replays tests/fuzz/corpus/TARGET: a minimized set of inputs, and those that once found a
# bug.
function(tessera_add_fuzz_target name)
  add_executable(fuzz_${name} ${tests}/fuzz/fuzz_${name}.cpp ${ARGN})
  target_link_libraries(fuzz_${name} PRIVATE tessera_options tessera_instruction_set tessera_kernels tessera_engine $<TARGET_NAME_IF_EXISTS:tessera_scene>
    TBB::tbb glm::glm Threads::Threads ${CMAKE_DL_LIBS})
  target_compile_options(fuzz_${name} PRIVATE $<$<CONFIG:Release>:-O1>)  # most time is spent in the code under test
  if(TESSERA_SANITIZE MATCHES fuzzer)
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    set(replay -runs=0)
  else()
    target_sources(fuzz_${name} PRIVATE ${tests}/fuzz/replay.cpp)
    set(replay)
  endif()
  add_test(NAME Fuzz.${name} COMMAND fuzz_${name} ${replay} ${tests}/fuzz/corpus/${name})
  set_tests_properties(Fuzz.${name} PROPERTIES LABELS unit TIMEOUT 300)
  add_dependencies(fuzz_targets fuzz_${name})
endfunction()

add_custom_target(fuzz_targets)
tessera_add_fuzz_target(pipeline ${tests}/fuzz/pipeline_case.cpp ${tests}/fuzz/pipeline_state.cpp)
if(TARGET tessera_scene)
  set(import ${PROJECT_SOURCE_DIR}/engine/program/import)
  tessera_add_fuzz_target(scene ${tests}/fuzz/files.cpp)
  target_link_libraries(fuzz_scene PRIVATE nlohmann_json::nlohmann_json)
  tessera_add_fuzz_target(obj ${tests}/fuzz/files.cpp)
  tessera_add_fuzz_target(stl)
  tessera_add_fuzz_target(ply)
  tessera_add_fuzz_target(model_bytes)
  tessera_add_fuzz_target(gltf ${tests}/fuzz/files.cpp)
  target_link_libraries(fuzz_gltf PRIVATE nlohmann_json::nlohmann_json)
  tessera_add_fuzz_target(gltf_view)
  target_link_libraries(fuzz_gltf_view PRIVATE nlohmann_json::nlohmann_json)
  tessera_add_fuzz_target(assimp_scene ${import}/assimp_model.cpp ${import}/assimp_material.cpp ${import}/assimp_view.cpp)
  target_link_libraries(fuzz_assimp_scene PRIVATE assimp::assimp)
  tessera_add_fuzz_target(threemf ${import}/threemf.cpp ${import}/threemf_package.cpp ${import}/threemf_resources.cpp
    ${import}/threemf_xml.cpp)
  target_link_libraries(fuzz_threemf PRIVATE PkgConfig::MINIZIP pugixml::pugixml)
  tessera_add_fuzz_target(picture ${tests}/fuzz/files.cpp)
  target_link_libraries(fuzz_picture PRIVATE PNG::PNG)
endif()

# bin/tessera-bench, which `tessera bench` and `tessera price` execute. Included by CMakeLists.txt if the program is built.
file(GLOB tessera_bench_sources CONFIGURE_DEPENDS perf/bench/*.cpp perf/prices/*.cpp)
list(FILTER tessera_bench_sources EXCLUDE REGEX "/(main|no_mesa)\\.cpp$")
find_path(TESSERA_OSMESA_INCLUDE GL/osmesa.h)
mark_as_advanced(TESSERA_OSMESA_INCLUDE)
if(TESSERA_OSMESA_INCLUDE)
  list(APPEND tessera_bench_sources perf/rivals/mesa_workload.cpp perf/rivals/mesa_functions.cpp)
else()
  message(STATUS "GL/osmesa.h not found: tessera bench is built without --rivals")
  list(APPEND tessera_bench_sources perf/bench/no_mesa.cpp)
endif()
list(APPEND tessera_bench_sources perf/rivals/literal_shaders.cpp
  engine/program/cli/bitmap_font.cpp engine/program/cli/scene_input.cpp engine/program/cli/progress.cpp
  engine/program/cli/machine_text.cpp)
add_library(tessera_bench_parts OBJECT ${tessera_bench_sources})
# Internals that the library does not export: the worker pool and plane stores.
tessera_add_objects(tessera_bench_internals
  engine/runtime/floating_point_mode.cpp engine/runtime/worker_pool.cpp framebuffer/bit_transpose.cpp
  framebuffer/bitplane.cpp framebuffer/prefetch_lines.cpp framebuffer/instruction_set.cpp)
set_target_properties(tessera_bench_internals PROPERTIES UNITY_BUILD OFF)  # kernels, as in tessera_kernels
add_executable(tessera_bench perf/bench/main.cpp
  $<TARGET_OBJECTS:tessera_bench_internals> $<TARGET_OBJECTS:tessera_bench_parts>)
foreach(target tessera_bench_parts tessera_bench)
  target_link_libraries(${target} PRIVATE
    tessera_command_line tessera_scene tessera TBB::tbb)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)  # the measured code is in the library
endforeach()
if(TESSERA_OSMESA_INCLUDE)
  target_include_directories(tessera_bench_parts SYSTEM PRIVATE ${TESSERA_OSMESA_INCLUDE})
endif()
set_target_properties(tessera_bench PROPERTIES OUTPUT_NAME tessera-bench)

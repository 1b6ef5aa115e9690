# bin/tessera-accuracy, which `tessera accuracy` executes: errors against the reference renderer in tests, times
# of settings, and a report. Included by CMakeLists.txt if the program is built and the reference is there.
include(tests/reference/reference.cmake)

set(accuracy_dir ${CMAKE_CURRENT_SOURCE_DIR}/perf/accuracy)
set(report_dir ${accuracy_dir}/report)
set(tessera_report_files ${CMAKE_CURRENT_BINARY_DIR}/report_files.cpp)
add_custom_command(OUTPUT ${tessera_report_files}
  COMMAND ${CMAKE_COMMAND} -DFOLDER=${report_dir} -DOUTPUT=${tessera_report_files} -P ${report_dir}/report.cmake
  DEPENDS ${report_dir}/report.cmake ${report_dir}/page.html ${report_dir}/style.css ${report_dir}/report.js
          ${report_dir}/vendor/d3.min.js ${report_dir}/vendor/plot.umd.min.js
  COMMENT "Embedding the report page" VERBATIM)

file(GLOB tessera_accuracy_sources CONFIGURE_DEPENDS ${accuracy_dir}/*.cpp)
list(REMOVE_ITEM tessera_accuracy_sources ${accuracy_dir}/main.cpp)
list(APPEND tessera_accuracy_sources ${tessera_report_files}
  engine/program/cli/progress.cpp engine/program/cli/machine_text.cpp perf/bench/statistics.cpp perf/bench/counters.cpp)
add_library(tessera_accuracy_parts OBJECT ${tessera_accuracy_sources})
add_executable(tessera_accuracy perf/accuracy/main.cpp $<TARGET_OBJECTS:tessera_accuracy_parts>)
foreach(target tessera_accuracy_parts tessera_accuracy)
  target_link_libraries(${target} PRIVATE tessera_command_line tessera_reference tessera_scene tessera
    TBB::tbb Threads::Threads)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)  # the measured code is in the library
endforeach()
# Part of the measured frames of lower resolutions.
set_source_files_properties(${accuracy_dir}/enlarge.cpp PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>")
set_target_properties(tessera_accuracy PROPERTIES OUTPUT_NAME tessera-accuracy)

# Embeds the files of the report page:
#   cmake -DFOLDER=perf/accuracy/report -DOUTPUT=file -P report.cmake
set(hash_d3.min.js 912111098ea99503a6f4967361d2bbdc9dbf58cf9c678c8e27e5b02d1a07f0c1)
set(hash_plot.umd.min.js 4358086467740777dd788d6b27a95cebdbaefdd50c730a3060117073bd7134cb)
foreach(library d3.min.js plot.umd.min.js)
  file(SHA256 ${FOLDER}/vendor/${library} found)
  if(NOT found STREQUAL hash_${library})
    message(FATAL_ERROR "${FOLDER}/vendor/${library} has the SHA-256 ${found}, expected ${hash_${library}}")
  endif()
endforeach()

set(text "#include \"perf/accuracy/report_files.h\"\n\nnamespace tessera::accuracy {\n\n")
foreach(pair "kReportPage=page.html" "kReportStyle=style.css" "kReportScript=report.js"
        "kD3Script=vendor/d3.min.js" "kPlotScript=vendor/plot.umd.min.js")
  string(REGEX MATCH "^([^=]+)=(.+)$" matched "${pair}")
  set(name ${CMAKE_MATCH_1})
  file(READ "${FOLDER}/${CMAKE_MATCH_2}" content)
  string(APPEND text "const std::string_view ${name} = R\"embedded(${content})embedded\";\n")
endforeach()
file(WRITE "${OUTPUT}" "${text}\n}  // namespace tessera::accuracy\n")

# Generates the source of selftest_scenes.h:
#   cmake -DLIST=file -DSCENES=folder -DHASHES=file -DOUTPUT=file -P embed_selftest.cmake
file(STRINGS "${LIST}" lines)
file(STRINGS "${HASHES}" hashes)
set(hash_lines "")
set(scenes "")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^([a-z0-9_]+) +([^\"\\]+)$")
    message(FATAL_ERROR "${LIST}: found \"${line}\", expected a scene's name, blanks and a description")
  endif()
  set(name ${CMAKE_MATCH_1})
  set(description ${CMAKE_MATCH_2})
  set(hash ${hashes})
  list(FILTER hash INCLUDE REGEX "^${name} ")
  if(NOT hash MATCHES "^[a-z0-9_]+( [0-9a-f]+)+$")
    message(FATAL_ERROR "${HASHES} lacks the hashes of scene \"${name}\", which ${LIST} names")
  endif()
  file(READ "${SCENES}/${name}.json" scene)
  string(APPEND hash_lines "${hash}\n")
  string(APPEND scenes "    {\"${name}\", \"${description}\", R\"embedded(${scene})embedded\"},\n")
endforeach()
file(WRITE "${OUTPUT}"
"#include \"engine/program/cli/selftest_scenes.h\"

namespace tessera::program::cli {
namespace {

constexpr SelftestScene kScenes[] = {
${scenes}};

}  // namespace

const std::span<const SelftestScene> kSelftestScenes = kScenes;
const std::string_view kSelftestHashes = R\"embedded(${hash_lines})embedded\";

}  // namespace tessera::program::cli
")

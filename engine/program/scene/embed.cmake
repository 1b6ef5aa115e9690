# Generates the source of embedded.h: cmake -DTEAPOT=file -DSCENE=file -DOUTPUT=file -P embed.cmake
file(READ "${TEAPOT}" teapot)
file(READ "${SCENE}" scene)
file(WRITE "${OUTPUT}"
"#include \"engine/program/scene/embedded.h\"

namespace tessera::program {

const std::string_view kTeapotPatches = R\"embedded(${teapot})embedded\";
const std::string_view kBuiltinScene = R\"embedded(${scene})embedded\";

}  // namespace tessera::program
")

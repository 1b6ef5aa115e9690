# Generates the source of gallery_files.h: cmake -DFOLDER=folder -DOUTPUT=file -P embed_gallery.cmake
file(GLOB paths "${FOLDER}/*.json" "${FOLDER}/*.obj" "${FOLDER}/*.mtl" "${FOLDER}/gallery.txt")
set(files "")
foreach(path IN LISTS paths)
  get_filename_component(name "${path}" NAME)
  file(READ "${path}" content)
  string(APPEND files "    {\"${name}\", R\"embedded(${content})embedded\"},\n")
endforeach()
file(WRITE "${OUTPUT}"
"#include \"engine/program/cli/gallery_files.h\"

namespace tessera::program::cli {
namespace {

constexpr GalleryFile kFiles[] = {
${files}};

}  // namespace

const std::span<const GalleryFile> kGalleryFiles = kFiles;

}  // namespace tessera::program::cli
")

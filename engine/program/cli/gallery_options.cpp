// Options of `tessera gallery`.
#include <string>

#include "engine/program/cli/command_options.h"
#include "engine/program/cli/gallery_list.h"
#include "engine/program/cli/validators.h"

namespace tessera::program::cli {
namespace {

constexpr const char* kGalleryExamples = R"(Examples:
  tessera gallery pictures                        all pictures, pictures/index.html and a contact sheet
  tessera gallery pictures shadow_point mode_cga  two of them
  tessera gallery --list                          their names)";

}  // namespace

CLI::App* add_gallery(CLI::App& program, GalleryRequest& request) {
  CLI::App* command = program.add_subcommand(
      "gallery",
      "Draw pictures of what the renderer can do, each from a scene file that is written next to it");
  command->footer(kGalleryExamples);
  command->option_defaults()->take_last();
  command
      ->add_option("DIR", request.folder,
                   "folder for the pictures, their scenes, index.html and the contact sheet index.png")
      ->option_text("DIR")
      ->check(not_empty("DIR's name"));
  command->add_option("NAME", request.names, "pictures to draw; default: all")
      ->option_text("[NAME...]")
      ->take_all()
      ->check(CLI::Validator([](const std::string& name) { return error_of_gallery_name(name); }, ""));
  command->add_flag("--list", request.list, "print the names of the pictures, and what they show");
  command->add_option("--threads", request.threads, "threads; default: TESSERA_THREADS, or all cores")
      ->option_text("N")
      ->transform(integer_from(1, 1024));
  command->parse_complete_callback([&request] {
    if (request.list && !request.folder.empty())
      throw CLI::ValidationError("--list", "prints names without drawing, excludes DIR");
    if (!request.list && request.folder.empty())
      throw CLI::ValidationError("DIR", "found none, expected the folder for the pictures, or --list");
  });
  return command;
}

}  // namespace tessera::program::cli

// Reads a model from bytes as import_model() does, without a child process, and draws it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/program/import/model_bytes.h"
#include "engine/program/import/model_file.h"
#include "engine/program/import/model_normals.h"
#include "engine/program/scene/model_scene.h"
#include "tests/fuzz/render_small.h"
#include "tests/fuzz/target.h"

namespace tessera::fuzz {

/// The error must name the file and have one line.
inline void check_message(const std::string& name, const std::string& message) {
  require(message.starts_with(name), "an error does not name the file");
  require(message.find('\n') == message.npos, "an error has several lines");
}

/// @param read  reads a model from a ModelFile, for a ModelUse
template <class Read>
void read_and_render(const std::string& name, std::string_view bytes, const Read& read) {
  for (const ModelUse use : {ModelUse::mesh, ModelUse::display}) {
    std::optional<Model> model;
    if (const auto error = error_of([&] {
          ModelFile file(name, bytes);
          model = read(file, use, ReportProgress());
        })) {
      check_message(name, *error);
      continue;
    }
    if (use == ModelUse::display) {
      for (ModelPart& part : model->parts) part.texture.reset();  // not decoded here
      complete_normals(*model);
    }
    const std::string sent = to_bytes(*model);
    std::optional<Model> received;
    if (const auto error = error_of([&] { received = model_from_bytes(sent, name); }))
      finding("the model is refused: " + *error);
    require(to_bytes(*received) == sent, "serialization changed the model");
    if (use == ModelUse::display) error_of([&] { render_small(model_scene(*received, name, 24, 32)); });
  }
}

}  // namespace tessera::fuzz

// The named user stages of scenes. They use the public interface of stages and nothing else.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/program/scene/json_value.h"
#include "engine/program/scene/mesh_data.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {

/// A named stage with its parameters. Its functions work in place on the arrays of a block.
class NamedStage {
 public:
  virtual ~NamedStage() = default;
  virtual VertexStage vertex_stage() const { return {}; }      ///< reads, writes and extras
  virtual FragmentStage fragment_stage() const { return {}; }  ///< reads, writes_depth and discards
  virtual bool has_vertices() const { return false; }
  virtual bool has_fragments() const { return false; }
  /// @param extras  number of the stage's first extra varying
  virtual void run(const VertexBlock&, std::size_t /*extras*/) const {}
  virtual void run(const FragmentBlock&, std::size_t /*extras*/) const {}
};

/// The stages of a draw, which run in the order of the scene. Immutable: many threads call it.
class NamedStages {
 public:
  /// Reads an array of stages.
  /// @param mesh       mesh of the draw
  /// @param transform  object to world space
  /// @throws Error for unknown names and parameters, and for more than kMaxExtras extra varyings
  NamedStages(const json::Value& value, const MeshData& mesh, const Matrix& transform);

  /// Sets the stages of a draw, which borrows this object. Vertex colours of a lit draw replace its
  /// material's colours if a stage makes them and `color_material` is none.
  void attach(DrawState& state) const;

 private:
  struct Placed {
    std::unique_ptr<NamedStage> stage;
    std::size_t extras = 0;
  };
  std::vector<Placed> stages_;
  std::string vertex_names_, fragment_names_;  // for explain
  VertexStage vertex_stage_;
  FragmentStage fragment_stage_;
};

}  // namespace tessera::program

#include "engine/stages/vertex_stage.h"

#include <algorithm>
#include <span>

#include "engine/stages/geometry.h"

namespace tessera::detail {
namespace {

/// Arrays of a block: the stage reads and writes them in place.
struct BlockArrays {
  PositionBatch clip;
  float object[4][kVertexBatch];
  float eye[3][kVertexBatch];
  float normal[3][kVertexBatch];
  float color[4][kVertexBatch];
  float texcoord[2][kVertexBatch];
  float extras[kMaxExtras][kVertexBatch];
};

template <std::size_t components>
void fill(float (&arrays)[components][kVertexBatch], float value) {
  for (auto& array : arrays) std::fill(std::begin(array), std::end(array), value);
}

template <std::size_t components, class Pointers>
void point_to(float (&arrays)[components][kVertexBatch], Pointers& pointers) {
  for (std::size_t c = 0; c < components; ++c) pointers[c] = arrays[c];
}

class VertexBlockRun {
 public:
  VertexBlockRun(const GeometryDraw& draw, StridedFloats normals, std::size_t first, std::size_t count,
                 InstructionSet isa)
      : draw_(draw),
        mesh_(*draw.mesh),
        stage_(*draw.plan->vertex_stage),
        normals_(normals),
        first_(first),
        count_(count),
        isa_(isa) {}

  std::uint8_t operator()() {
    load_positions();
    load_attributes();
    stage_.run(block_, stage_.data);
    return store();
  }

 private:
  bool uses(bool VertexValues::*value) const { return stage_.reads.*value || stage_.writes.*value; }

  std::size_t extras() const { return static_cast<std::size_t>(std::clamp(stage_.extras, 0, kMaxExtras)); }

  void load_positions() {
    const DrawPlan& plan = *draw_.plan;
    const StridedFloats positions = mesh_.positions.from(first_);
    block_.first = first_;
    block_.count = count_;
    block_.clip_from_object = plan.transform.clip_from_object;
    block_.eye_from_object = plan.eye.eye_from_object;
    if (stage_.reads.object) {
      for (std::size_t i = 0; i < count_; ++i)
        for (std::size_t c = 0; c < 4; ++c)
          arrays_.object[c][i] = c < static_cast<std::size_t>(mesh_.components) ? positions.at(i)[c] : 1.0f;
      point_to(arrays_.object, block_.object);
    }
    if (uses(&VertexValues::eye)) {
      if (stage_.reads.eye)
        eye_positions(isa_)(plan.eye, positions, mesh_.components, count_, arrays_.eye[0], arrays_.eye[1],
                            arrays_.eye[2]);
      else fill(arrays_.eye, 0);
      point_to(arrays_.eye, block_.eye);
    }
    if (uses(&VertexValues::clip)) {
      if (stage_.reads.clip)
        clip_positions(isa_)(plan.transform, positions, mesh_.components, count_, arrays_.clip);
      else arrays_.clip = {};
      block_.clip = {arrays_.clip.x, arrays_.clip.y, arrays_.clip.z, arrays_.clip.w};
    }
  }

  void load_attributes() {
    if (uses(&VertexValues::normal)) {
      if (stage_.reads.normal && normals_)
        eye_normals(isa_)(draw_.plan->eye, normals_.from(first_), count_, arrays_.normal[0],
                          arrays_.normal[1], arrays_.normal[2]);
      else fill(arrays_.normal, 0);
      point_to(arrays_.normal, block_.normal);
    }
    if (uses(&VertexValues::color)) {
      const bool has_colors = mesh_.colors || mesh_.color_bytes != nullptr;
      fill(arrays_.color, stage_.reads.color ? 1 : 0);
      for (std::size_t i = 0; i < count_ && has_colors && stage_.reads.color; ++i)
        for (std::size_t c = 0; c < 4; ++c) arrays_.color[c][i] = mesh_.color(first_ + i, c);
      point_to(arrays_.color, block_.color);
    }
    if (uses(&VertexValues::texcoord)) {
      fill(arrays_.texcoord, 0);
      for (std::size_t i = 0; i < count_ && mesh_.texcoords && stage_.reads.texcoord; ++i)
        for (std::size_t c = 0; c < 2; ++c) arrays_.texcoord[c][i] = mesh_.texcoords.at(first_ + i)[c];
      point_to(arrays_.texcoord, block_.texcoord);
    }
    for (std::size_t k = 0; k < extras(); ++k) {
      std::fill_n(arrays_.extras[k], kVertexBatch, 0.0f);
      block_.extras[k] = arrays_.extras[k];
    }
  }

  std::uint8_t store() {
    StagedVertices& staged = draw_.buffers->staged;
    std::uint8_t outcodes = 0;
    if (stage_.writes.clip) {
      outcodes = place_vertices(isa_)(draw_.plan->transform, arrays_.clip, count_,
                                      draw_.buffers->vertices.data() + first_,
                                      draw_.buffers->outcodes.data() + first_);
      for (std::size_t i = 0; i < count_; ++i)
        staged.clip.data()[first_ + i] = {arrays_.clip.x[i], arrays_.clip.y[i], arrays_.clip.z[i],
                                          arrays_.clip.w[i]};
    }
    if (stage_.writes.eye) outcodes |= store_rows(std::span(arrays_.eye), staged.eye);
    if (stage_.writes.normal) outcodes |= store_rows(std::span(arrays_.normal), staged.normals);
    if (stage_.writes.color) outcodes |= store_rows(std::span(arrays_.color), staged.colors);
    if (stage_.writes.texcoord) outcodes |= store_rows(std::span(arrays_.texcoord), staged.texcoords);
    if (extras() > 0) outcodes |= store_rows(std::span(arrays_.extras).first(extras()), staged.extras);
    return outcodes;
  }

  /// Stores one array per component as rows. Primitives of vertices with a value that is not finite are
  /// dropped.
  std::uint8_t store_rows(std::span<float[kVertexBatch]> columns, Scratch<float>& rows) {
    float* out = rows.data() + first_ * columns.size();
    std::uint8_t any = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      float probe = 0;
      for (const auto& column : columns) {
        *out++ = column[i];
        probe += column[i] * 0.0f;
      }
      if (!(probe == 0)) any = draw_.buffers->outcodes.data()[first_ + i] |= kNonFinite;
    }
    return any;
  }

  const GeometryDraw& draw_;
  const MeshArrays& mesh_;
  const VertexStage& stage_;
  const StridedFloats normals_;
  const std::size_t first_, count_;
  const InstructionSet isa_;
  VertexBlock block_;
  BlockArrays arrays_;
};

}  // namespace

void StagedVertices::resize(const VertexStage& stage, std::size_t vertices) {
  const auto count = [&](bool is_written, std::size_t components) {
    return is_written ? components * vertices : 0;
  };
  clip.resize(count(stage.writes.clip, 1));
  eye.resize(count(stage.writes.eye, 3));
  normals.resize(count(stage.writes.normal, 3));
  colors.resize(count(stage.writes.color, 4));
  texcoords.resize(count(stage.writes.texcoord, 2));
  extras.resize(count(true, static_cast<std::size_t>(stage.extras)));
}

std::uint8_t run_vertex_stage(const GeometryDraw& draw, StridedFloats normals, std::size_t first,
                              std::size_t count, InstructionSet isa) {
  return VertexBlockRun(draw, normals, first, count, isa)();
}

}  // namespace tessera::detail

#include "engine/runtime/renderer_state.h"

#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include "engine/buffers/image_target.h"
#include "engine/record/recording.h"
#include "engine/runtime/out_of_memory.h"

namespace tessera {
using namespace detail;
namespace {

constexpr int kMaxThreads = 1024;

}  // namespace

std::string_view version() { return TESSERA_VERSION; }

std::vector<InstructionSet> available_instruction_sets() { return available_isas(); }

std::string_view name(InstructionSet set) {
  switch (set) {
    case InstructionSet::automatic: return "automatic";
    case InstructionSet::scalar: return "scalar";
    case InstructionSet::avx2: return "avx2";
    case InstructionSet::avx512: return "avx512";
  }
  return "";
}

Renderer::Renderer(RendererOptions options) try {
  if (options.threads < 0 || options.threads > kMaxThreads)
    throw Error(ErrorCode::invalid_argument, "Renderer: threads is " + std::to_string(options.threads) +
                                                 ", must be 0 (all cores) to " + std::to_string(kMaxThreads));
  const int tile_size = options.tile_size;
  const bool has_tile_size = tile_size == 32 || tile_size == 64 || tile_size == 128;
  if (tile_size != 0 && !has_tile_size)
    throw Error(ErrorCode::invalid_argument, "Renderer: tile_size is " + std::to_string(options.tile_size) +
                                                 ", must be 0 (chosen), 32, 64 or 128");
  if (options.bin_memory < kMinBinMemory)
    throw Error(ErrorCode::invalid_argument, "Renderer: bin_memory is " + std::to_string(options.bin_memory) +
                                                 " bytes, must be at least " + std::to_string(kMinBinMemory));
  const std::vector<InstructionSet> sets = available_instruction_sets();
  if (options.instruction_set == InstructionSet::automatic) options.instruction_set = sets.front();
  if (std::find(sets.begin(), sets.end(), options.instruction_set) == sets.end()) {
    std::string known;
    for (const InstructionSet set : sets) known += (known.empty() ? "" : ", ") + std::string(name(set));
    throw Error(ErrorCode::unsupported, "Renderer: the instruction set " +
                                            std::string(name(options.instruction_set)) +
                                            " is not in this build or machine, which have " + known);
  }
  if (options.executor && options.executor->workers() < 1)
    throw Error(ErrorCode::invalid_argument, "Renderer: the executor has " +
                                                 std::to_string(options.executor->workers()) +
                                                 " workers, must have at least 1");
  if (options.threads == 0)
    options.threads =
        std::min(options.executor ? options.executor->workers() : default_concurrency(), kMaxThreads);
  const InstructionSet isa = options.instruction_set;
  state_ = std::make_unique<RendererState>(std::move(options), isa);
  RendererState& state = *state_;
  state.options.threads = state.worker_pool.threads();
  state.log(LogLevel::info, [&] {
    return "tessera " TESSERA_VERSION ": " + std::to_string(state.options.threads) +
           (state.options.threads == 1 ? " thread, " : " threads, ") +
           std::string(name(state.options.instruction_set));
  });
} catch (const std::bad_alloc&) {
  throw Error(ErrorCode::out_of_memory, "Renderer: not enough memory");
}
Executor::~Executor() = default;
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
const RendererOptions& Renderer::options() const noexcept { return state_->options; }
const WorkCounts& Renderer::work_counts() const noexcept { return state_->work_counts; }

std::span<const DrawMeasurement> Renderer::draw_measurements() const noexcept {
  return state_->draw_measurer.results();
}

namespace {

FrameRecording& require_recording(const std::unique_ptr<FrameRecording>& recording) {
  if (!recording) throw Error(ErrorCode::invalid_state, "Renderer::finish: the frame was moved from");
  return *recording;
}

FrameStats finish_frame(RendererState& state, FrameRecording& recording, const ImageTarget* image) {
  if (state.worker_pool.is_running())
    throw Error(
        ErrorCode::invalid_state,
        "Renderer::finish: called by this renderer's own progress callback; a frame must have ended before "
        "the next one");
  return translate_bad_alloc("Renderer::finish", [&] {
    const FrameStats stats = state.run(recording, image);
    state.report(stats);
    recording.clear();
    return stats;
  });
}

}  // namespace

FrameStats Renderer::finish(Frame& frame) {
  return finish_frame(*state_, require_recording(frame.recording_), nullptr);
}

FrameStats Renderer::finish(Frame& frame, const ImageTarget& target) {
  FrameRecording& recording = require_recording(frame.recording_);
  check_image_target(target, recording.target->format, "Renderer::finish");
  return finish_frame(*state_, recording, &target);
}

}  // namespace tessera

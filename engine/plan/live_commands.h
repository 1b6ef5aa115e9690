// Commands of a frame whose result is read: by a later command, a store, or the picture.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/record/recording.h"

namespace tessera::detail {

/// One flag per Buffer.
using BufferFlags = std::array<bool, 4>;

/// Per recorded command. Memory is kept from frame to frame.
struct LiveCommands {
  std::vector<std::uint8_t> draws;
  std::vector<BufferFlags> clears;  ///< per buffer that the clear replaces
  std::vector<std::uint8_t> accumulations;
};

/// Walks backwards through a frame. A command is dead if each buffer that it changes is replaced as a whole,
/// or discarded, before anything reads it.
/// @param live      is replaced
/// @param read_at_end  buffers that are stored or shown after the last command
void find_live_commands(LiveCommands& live, const FrameRecording& recording, BufferFlags read_at_end);

/// Buffers whose contents may be read after the frame, with any way to finish it: for explanations.
BufferFlags buffers_after_frame(const FrameRecording& recording);

}  // namespace tessera::detail

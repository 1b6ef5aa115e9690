// Serializes a model for the pipe from the process that read it.
#pragma once

#include <cstdint>
#include <string>

#include "engine/program/import/byte_stream.h"
#include "engine/program/import/model.h"

namespace tessera::program {

/// Writes the model piece by piece, without a copy of it; large arrays are one piece each.
void write_model(const Model& model, const ByteWriter& write);
/// Number of bytes that write_model() writes.
std::uint64_t model_byte_count(const Model& model);
std::string to_bytes(const Model& model);

/// Reads what write_model() wrote.
/// @param bytes  size of the model, and limit of the bytes that are read
/// @param path  the model's file, for messages
/// @throws Error, naming the file, for bytes that do not hold a valid model: the process that sent them may
///   have crashed. Errors of `read` propagate
Model read_model(const ByteReader& read, std::uint64_t bytes, const std::string& path);

/// read_model() for bytes in memory.
Model model_from_bytes(const std::string& bytes, const std::string& path);

}  // namespace tessera::program

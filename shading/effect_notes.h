// Collects the notes about a draw's effects while it is planned.
#pragma once

#include <vector>

#include "framebuffer/tessera/effect_note.hpp"

namespace tessera::detail {

class EffectNotes {
 public:
  /// @param list  receives the notes; null discards them, as when a frame is rendered
  EffectNotes(std::vector<EffectNote>* list) : list_(list) {}

  /// Adds notes about the lighting of back faces to the same list.
  EffectNotes for_back_faces() const {
    EffectNotes notes(list_);
    notes.back_faces_ = true;
    return notes;
  }

  void add(EffectNote note) const {
    if (list_ == nullptr) return;
    note.back_faces = back_faces_;
    list_->push_back(note);
  }
  void active(Effect effect, EffectReason reason = EffectReason::requested,
              std::string_view cause = {}) const {
    add({.effect = effect, .reason = reason, .cause = cause});
  }
  void skipped(Effect effect, EffectReason reason, std::string_view cause = {}) const {
    add({.effect = effect, .active = false, .reason = reason, .cause = cause});
  }

 private:
  std::vector<EffectNote>* list_;
  bool back_faces_ = false;
};

}  // namespace tessera::detail

#include "choose_clip.hpp"

#include <string>

#include <bodice/engine/message.hpp>

namespace bodice::tryon {

engine::Result<rig::Clip> choose_clip(const MotionChoice& choice, const std::vector<rig::Clip>& clips) {
  if (choice.clip.empty() && !clips.empty()) return clips.front();
  std::string names;
  for (const rig::Clip& clip : clips) {
    if (clip.name == choice.clip) return clip;
    names += (names.empty() ? "'" : ", '") + clip.name + "'";
  }
  return engine::Error{engine::ErrorCode::kInvalidArgument,
                       engine::message(choice.motion, ": there is no clip '", choice.clip, "'."),
                       clips.empty() ? "The file has no clips." : "Its clips are " + names + "."};
}

}  // namespace bodice::tryon

// Frames to a video file through ffmpeg, or to numbered pictures.
#pragma once

#include <memory>
#include <string>

#include "simulator/render/child_process.h"
#include "simulator/render/image.h"

namespace plumbline::render {

/// An .mp4 (H.264, yuv420p, which every player shows) where ffmpeg is installed; otherwise a folder beside
/// it, NAME.frames, with frame_00001.png and so on. Nothing stays behind unless finish() is reached: the
/// video is made under another name and then renamed.
class Video {
 public:
  /// Width and height must be even. Throws InputError for a folder that cannot be written.
  Video(const std::string& file, int width, int height, double frames_per_second);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  void add(const Image& frame);
  /// The file or folder that was written. Throws std::runtime_error with ffmpeg's last words.
  std::string finish();
  bool encoded() const { return encoded_; }

 private:
  [[noreturn]] void fail();

  std::string file_, temporary_;
  bool encoded_;
  int frames_ = 0;
  std::unique_ptr<ChildProcess> encoder_;
};

}  // namespace plumbline::render

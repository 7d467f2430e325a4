#include "simulator/render/video.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"

namespace plumbline::render {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> encoder(const std::string& file, int width, int height, double rate) {
  return {"ffmpeg",
          "-y",
          "-loglevel",
          "error",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-s",
          std::to_string(width) + "x" + std::to_string(height),
          "-r",
          number_text(rate),
          "-i",
          "pipe:0",
          "-c:v",
          "libx264",
          "-preset",
          "veryfast",
          "-crf",
          "18",
          "-pix_fmt",
          "yuv420p",
          "-movflags",
          "+faststart",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-map_metadata",
          "-1",
          "-f",
          "mp4",
          file};
}

std::string frame_name(int number) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "frame_%05d.png", number);
  return name.data();
}

/// Only what an earlier run wrote may be replaced.
void refuse_other_content(const std::string& folder) {
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("frame_", 0) != 0 || entry.path().extension() != ".png") {
      throw InputError({folder, 0, ""}, "a folder with " + name, "none, or one with frames only");
    }
  }
}

}  // namespace

Video::Video(const std::string& file, int width, int height, double frames_per_second)
    : file_(file), encoded_(program_exists("ffmpeg")) {
  if (!encoded_) {
    file_ = (fs::path(file).replace_extension(".frames")).string();
    refuse_other_content(file_);
  }
  temporary_ = file_ + ".new" + std::to_string(getpid());
  if (encoded_) {
    encoder_ = std::make_unique<ChildProcess>(encoder(temporary_, width, height, frames_per_second));
    return;
  }
  std::error_code failed;
  fs::create_directory(temporary_, failed);
  if (failed) {
    throw InputError({file_, 0, ""}, "a folder that cannot be made", "a place for numbered pictures");
  }
}

Video::~Video() {
  encoder_.reset();
  std::error_code none;
  fs::remove_all(temporary_, none);
}

void Video::add(const Image& frame) {
  ++frames_;
  if (!encoded_) {
    write_png(frame, (fs::path(temporary_) / frame_name(frames_)).string());
  } else if (!encoder_->write(frame.rgb.data(), frame.rgb.size())) {
    fail();
  }
}

void Video::fail() {
  const int status = encoder_->finish();
  throw std::runtime_error("ffmpeg ended with status " + std::to_string(status) + ": " +
                           encoder_->last_words());
}

std::string Video::finish() {
  if (encoded_) {
    if (encoder_->finish() != 0) {
      throw std::runtime_error("ffmpeg failed: " + encoder_->last_words());
    }
  } else {
    fs::remove_all(file_);
  }
  fs::rename(temporary_, file_);
  return file_;
}

}  // namespace plumbline::render

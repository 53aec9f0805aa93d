// The frames of an animation: which are wanted, the names of their files, and a video of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace eyeray::engine::cli {

// "0:48", or "0:48:2" for every second one, as their numbers, the last with them. Error (bad_input) for
// anything else, and for more than a million.
std::vector<int> parse_frames(const std::string& text);

// "out.%04d.png" of frame 12 as "out.0012.png": %d, or %0Nd for N digits at least, stands in it once. Error
// (bad_input) for another name.
std::string frame_name(const std::string& pattern, int frame);

// Error (bad_input) for a name that is no video's, Error (file_io) where it could not be written.
void check_video_name(const std::string& output);
// The same, and Error (file_io) where no ffmpeg is installed.
void check_video(const std::string& output);
// The pictures one after the other as a video, by ffmpeg; it takes its place when it is whole. Error
// (file_io) where ffmpeg fails.
void make_video(const std::vector<std::filesystem::path>& pictures, double frames_per_second,
                const std::string& output);

}  // namespace eyeray::engine::cli

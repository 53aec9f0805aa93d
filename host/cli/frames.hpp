// The frames of an animation: their numbers, the names of their files, and a video of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace eyeray::engine::cli {

// The numbers of the frames that "0:48" names, or "0:48:2" for every second one; the last frame is included.
// Error (bad_input) for anything else, and for more than a million.
std::vector<int> parse_frames(const std::string& text);

// The file name of a frame: "out.0012.png" for frame 12 of "out.%04d.png". `pattern` contains one %d,
// or one %0Nd for at least N digits. Error (bad_input) for another name.
std::string frame_name(const std::string& pattern, int frame);

// Error (bad_input) if the name is not that of a video, Error (file_io) if the file could not be written.
void check_video_name(const std::string& output);
// Checks the name as check_video_name does; Error (file_io) also if ffmpeg is not installed.
void check_video(const std::string& output);
// Makes a video of the pictures, one after the other, by ffmpeg. The file appears once it is complete. Error
// (file_io) if ffmpeg fails.
void make_video(const std::vector<std::filesystem::path>& pictures, double frames_per_second,
                const std::string& output);

}  // namespace eyeray::engine::cli

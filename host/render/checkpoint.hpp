// A file with the sums of an unfinished render, from which the render can be resumed.
//
// FILE, little-endian, written whole and atomically every time:
//
//   offset   bytes
//   0        8       "EYERAYCP"
//   8        4       version of this layout: 7
//   12       4       n, at most 65536
//   16       n       the identity: a line "name: value\n" for each of its parts
//   16 + n   8 each  RenderPosition, in the order of its members
//            4       CRC-32 of FILE.rows up to the last of finished_rows
//            4       CRC-32 of everything above
//            40 each the sums of the band's pixels, top row first: red, green, blue (float64), hits, rays,
//                    flags, samples and in the highest bit whether it takes no more (uint32)
//            8 each  the sums of each channel (the identity names them), of the same pixels (float64)
//            4 each  with --reject-fireflies, the colours' sums of each group of samples of the same pixels
//                    (float32)
//            4       CRC-32 of the sums
//
// FILE.rows holds the finished rows above the band (film/row_store.hpp); a picture of one band has none.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "host/core/stopwatch.hpp"
#include "host/film/row_store.hpp"

namespace eyeray::engine::render {

// A fact that decides a picture's bits: a render is resumed only if all such facts are the same.
struct IdentityPart {
  std::string name;   // "samples a pixel", for messages
  std::string value;  // without line breaks
  bool shown = true;  // whether messages show the value: people cannot read a hash
};

// The progress of a render.
struct RenderPosition {
  uint64_t finished_rows = 0;   // above the band, counted from the top of the rendered rows
  uint64_t samples = 0;         // samples of each pixel in the band's sums; with adaptive sampling the most
  uint64_t extra_rows = 0;      // the number of rows, from the band's top, whose sums hold one more sample
  uint64_t rays = 0;            // traced so far
  uint64_t flagged_pixels = 0;  // in the finished rows
  uint64_t flags = 0;           // in the finished rows
};

class Checkpoint {
 public:
  // A new checkpoint, to be written to `file` every `seconds`. Error (bad_input) if the file exists, so that
  // no forgotten checkpoint is lost; Error (file_io) if it cannot be written.
  static Checkpoint begin(std::filesystem::path file, std::vector<IdentityPart> identity, double seconds);
  // Reads the checkpoint `file`, which will also be written every `seconds`. Error (cannot_resume) if it is
  // missing, damaged, or of another render; the message then names the differences.
  static Checkpoint resume(std::filesystem::path file, std::vector<IdentityPart> identity, double seconds);

  const std::filesystem::path& file() const { return file_; }
  bool resumes() const { return input_ != nullptr; }

  // The contents of the file: the position; the band's sums, which read_sums reads into a film of their size;
  // and the finished rows, to be read from the top down. Error (cannot_resume) if they are damaged. Some
  // damage of the rows is found only after they were returned, by check_rows.
  const RenderPosition& position() const { return position_; }
  void read_sums(film::Film& film);
  film::Rows read_rows(int first, int count, int width, const film::Channels& channels);
  void check_rows() const;
  [[noreturn]] void damaged(const std::string& why) const;

  bool due() const { return failure_.empty() && since_saved_.seconds() >= seconds_; }
  // append_rows() and save() do not throw: failure() has the reason of a failure, and nothing more is written
  // after it.
  void append_rows(const film::Rows& rows);
  void save(const RenderPosition& position, const film::Film& film);
  // The reason why the file could not be written; "" if it could.
  const std::string& failure() const { return failure_; }
  // True if there is a file to resume from, even an older one.
  bool on_disk() const { return saved_ || resumes(); }
  // Removes the files, when the picture is done.
  void remove();

 private:
  Checkpoint(std::filesystem::path file, std::vector<IdentityPart> identity, double seconds);
  void read_header();
  template <typename Value>
  Value take(uint32_t& checksum);

  std::filesystem::path file_;
  std::vector<IdentityPart> identity_;
  double seconds_;
  std::unique_ptr<film::RowStore> rows_;
  std::unique_ptr<std::ifstream> input_;
  uint64_t input_bytes_ = 0;
  uint32_t rows_checksum_ = 0;
  RenderPosition position_;
  Stopwatch since_saved_;
  std::string failure_;
  bool saved_ = false;
};

}  // namespace eyeray::engine::render

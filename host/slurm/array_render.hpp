// A picture as an array of Slurm's jobs, a share each, and a job that merges the parts.
//
// Everything about it is in one folder, which the nodes share: parts, checkpoints, scripts, what jobs that
// failed said. No process but Slurm's has to stay: who asks again reads the folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host/slurm/scheduler.hpp"

namespace eyeray::slurm {

struct ArrayRequest {
  std::string program;                    // eyeray itself, where the nodes find it
  std::string scene;                      // its file
  std::vector<std::string> render_words;  // options of `eyeray render` that decide the picture
  std::vector<std::string> merge_words;   // of `eyeray merge`: outputs
  std::vector<std::string> frame_words;   // of an animation, `eyeray render`'s: frames, outputs; else empty
  std::string video;                      // of it; may be empty
  std::vector<std::string> sbatch_words;  // the user's
  std::vector<std::string> files;         // that are there at the end, for messages
  std::filesystem::path folder;           // of its own; made where it is missing
  int shards = 1;
  int retries = 2;       // how often a share is tried again
  std::string identity;  // names what decides the picture: parts of another are not taken
};

// How far it has come.
struct ArrayProgress {
  int parts = 0;
  size_t running = 0;
  size_t waiting = 0;
  std::string reason;    // why they wait
  bool merging = false;  // only the merge is left
  bool done = false;     // the picture is there
  std::string trouble;   // why nothing is known now, a sentence; else empty

  friend bool operator==(const ArrayProgress&, const ArrayProgress&) = default;
};

class ArrayRender {
 public:
  // Takes the folder up where it has been used for the same. Error (bad_input) where that was another
  // picture, Error (file_io) where it cannot be written.
  explicit ArrayRender(ArrayRequest request);

  const ArrayRequest& request() const { return request_; }
  // Looks, and submits what is missing and neither waits nor runs. Error with the code and the words of a
  // share that failed for good, Error (interrupted) when the array was cancelled, Error (file_io) when the
  // folder is gone.
  ArrayProgress look();
  // Of those jobs that may still be in the queue.
  std::vector<int> jobs() const;
  // Shares that were submitted again.
  int retried() const { return retried_; }

 private:
  struct Failure {
    int code = 0;
    std::string node, words;
  };
  // A share whose number is a task's and this more.
  struct Array {
    int job = 0;
    int offset = 0;
  };

  std::filesystem::path file(const std::string& name) const { return request_.folder / name; }
  std::string folder_in_pattern() const;
  std::string part_name(int number) const;
  std::filesystem::path failure_file(int number) const;
  std::vector<int> missing() const;
  Failure failure_of(int number) const;
  void judge(const std::vector<int>& missing);
  void submit_shares(const std::vector<int>& missing);
  void submit_merge();
  void write_scripts() const;
  void read_state();
  void write_state() const;

  ArrayRequest request_;
  std::vector<Array> arrays_;
  int merge_ = 0;                // 0: none
  int merges_ = 0;               // that were submitted with all parts there
  std::map<int, int> attempts_;  // of shares, that were not cut off with a checkpoint further on
  // Of shares that were submitted, when they were last written before.
  std::map<int, int64_t> checkpoints_;
  int retried_ = 0;
};

}  // namespace eyeray::slurm

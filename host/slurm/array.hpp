// A picture as an array of Slurm's jobs, a share each, and a job that merges their parts.
//
// One folder, which the nodes share, has everything: scripts, parts, checkpoints, jobs' output. The folder
// and Slurm's answer on the jobs' name are the picture's progress: nothing else is kept.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace eyeray::engine::slurm {

struct Array {
  std::string program;  // eyeray itself, where the nodes find it
  std::vector<std::string>
      render_words;                     // of `eyeray render`: the scene, the options, of an animation frames
  std::vector<std::string> last_words;  // the last job's: `merge`'s outputs, or a video's; empty: no such job
  std::vector<std::string> sbatch_words;  // the user's
  std::vector<std::string> files;         // that are there at the end
  std::filesystem::path folder;
  int shards = 1;
  // The files of frames that each share writes; empty of a picture, whose shares write parts.
  std::vector<std::vector<std::filesystem::path>> frames_of_shares = {};
  std::string contents;  // names the contents of the scene's files and of the program
  std::string job_name =
      {};  // of all jobs: squeue, sacct and scancel find them by --name; prepare() gives it

  bool is_picture() const { return frames_of_shares.empty(); }
  std::filesystem::path file(const std::string& name) const { return folder / name; }
  std::filesystem::path part(int share) const;
};

struct ArrayState {
  std::vector<int> missing;           // shares, counted from 1, that have not all of their files whole
  std::vector<std::string> faults;    // of parts that are there and of no use, a sentence each
  std::vector<std::string> queue;     // squeue's lines on it: "17_[3-64] PENDING 0:00 (Priority)"
  std::vector<std::string> failures;  // from Slurm's accounts: "17_2 OUT_OF_MEMORY 0:125 node7"
  std::filesystem::path output;       // output of the first job that ended too early; empty: none did
  bool done = false;                  // everything is there
};

// Renders one share, whose number is the task's plus the script's argument. A picture's share goes on from
// the checkpoint that a job before it left, and waits in the queue again when its time is nearly over.
std::string share_script(const Array& array);
// Merges the parts, or makes the video, and then leaves `merged`.
std::string merge_script(const Array& array);

// Takes the folder, and writes the scripts that are not there. Error (bad_input) when it holds other files or
// another picture, Error (file_io) when it cannot be written.
void prepare(Array& array);
// Reads every part that is there, and queries Slurm. Error (file_io) where Slurm does not answer.
ArrayState state_of(const Array& array);
// Submits the shares that are missing, and the merging job. Returns the jobs' numbers. Error (file_io) with
// Slurm's words where it takes none.
std::vector<std::string> submit(const Array& array, const ArrayState& state);

}  // namespace eyeray::engine::slurm

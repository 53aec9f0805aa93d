// Renders a picture by an array of Slurm's jobs, one for each share, and a job that merges their parts.
//
// One folder, which the nodes share, has everything: scripts, parts, checkpoints, jobs' output. This folder,
// and Slurm's answer about the jobs' name, give the picture's progress. Nothing else is kept.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace eyeray::engine::slurm {

struct Array {
  std::string program;  // the path at which the nodes find eyeray
  std::vector<std::string>
      render_words;  // for `eyeray render`: the scene, the options, an animation's frames
  std::vector<std::string>
      last_words;  // for the last job: outputs of `merge`, or of a video; empty: no such job
  std::vector<std::string> sbatch_words;  // the user's, for sbatch
  std::vector<std::string> files;         // that exist at the end
  std::filesystem::path folder;
  int shards = 1;
  // The files of frames that each share writes; empty for a picture, whose shares write parts.
  std::vector<std::vector<std::filesystem::path>> frames_of_shares = {};
  std::string contents;  // names the contents of the scene's files and of the program
  std::string job_name =
      {};  // the name of all jobs, by which squeue, sacct and scancel find them; prepare() sets it

  bool is_picture() const { return frames_of_shares.empty(); }
  std::filesystem::path file(const std::string& name) const { return folder / name; }
  std::filesystem::path part(int share) const;
};

struct ArrayState {
  std::vector<int> missing;           // shares, counted from 1, with a missing or incomplete file
  std::vector<std::string> faults;    // a sentence for each part that exists but is of no use
  std::vector<std::string> queue;     // squeue's lines about the jobs: "17_[3-64] PENDING 0:00 (Priority)"
  std::vector<std::string> failures;  // from Slurm's accounts: "17_2 OUT_OF_MEMORY 0:125 node7"
  std::filesystem::path output;       // output of the first job that ended too early; empty: none did
  bool done = false;                  // whether everything is there
};

// Renders one share, whose number is the task's plus the script's argument. A picture's share goes on from
// the checkpoint that a job before it left, and waits in the queue again when its time is nearly over.
std::string share_script(const Array& array);
// Merges the parts, or makes the video, and then creates the file `merged`.
std::string merge_script(const Array& array);

// Takes the folder for the picture, and writes missing scripts. Error (bad_input) if the folder holds other
// files or another picture, Error (file_io) if it cannot be written.
void prepare(Array& array);
// Reads every part that exists, and queries Slurm. Error (file_io) if Slurm does not answer.
ArrayState state_of(const Array& array);
// Submits the missing shares, and the merging job. Returns the jobs' numbers. Error (file_io), with Slurm's
// words, if Slurm accepts no job.
std::vector<std::string> submit(const Array& array, const ArrayState& state);

}  // namespace eyeray::engine::slurm

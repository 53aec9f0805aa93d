// Our own executors, as they race beside Embree.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "benchmarks/bench/field.hpp"
#include "host/executors/executor.hpp"

namespace eyeray::engine::bench {

class OwnContenders {
 public:
  // The contenders of `backends`. For gpu there is one for each of `incoherent` (ProfileOptions::incoherent).
  // The scene must outlive them. Error as make_executor.
  OwnContenders(const Scene& scene, const std::vector<std::string>& backends,
                const std::vector<std::string>& incoherent, const std::string& device);

  const std::vector<Contender>& contenders() const { return contenders_; }
  // The contenders' cost of packing the scene, known after the race: some of it is done on first use.
  std::vector<Build> builds() const;

 private:
  void add(const std::string& name, const Scene& scene, executors::Backend backend,
           const executors::ExecutorOptions& options);

  std::vector<std::unique_ptr<executors::Executor>> executors_;
  std::vector<Contender> contenders_;
  std::vector<double> seconds_;  // the time that making each executor took
};

}  // namespace eyeray::engine::bench

// A cluster of one node on this machine, with separate munged, slurmctld and slurmd, all in a temporary
// folder and on free ports.
#pragma once

#include <fmt/format.h>
#include <netinet/in.h>
#include <pwd.h>
#include <sys/socket.h>

#include <csignal>
#include <optional>
#include <thread>

#include "tests/support/process.hpp"

namespace eyeray::engine::test {

class Cluster {
 public:
  Cluster() {
    const std::string folder = folder_.path();
    for (const char* name : {"state", "spool"}) std::filesystem::create_directory(folder_ / name);
    write_text(folder_ / "munge.key", std::string(128, 'k'));
    std::filesystem::permissions(folder_ / "munge.key", std::filesystem::perms::owner_read);
    const std::string node = host_name(), user = getpwuid(geteuid())->pw_name;
    write_text(conf(), fmt::format(R"(ClusterName=test
SlurmctldHost={0}(127.0.0.1)
SlurmctldPort={1}
SlurmdPort={2}
AuthType=auth/munge
AuthInfo=socket={3}/munge.socket,cred_expire=30
SlurmUser={4}
SlurmdUser={4}
StateSaveLocation={3}/state
SlurmdSpoolDir={3}/spool
SlurmctldLogFile={3}/slurmctld.log
SlurmdLogFile={3}/slurmd.log
SlurmctldPidFile={3}/slurmctld.pid
SlurmdPidFile={3}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MpiDefault=none
JobCompType=jobcomp/none
SlurmctldTimeout=3600
SlurmdTimeout=3600
MessageTimeout=100
KillWait=10
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName={0} NodeAddr=127.0.0.1 CPUs=2 RealMemory=500 State=UNKNOWN
PartitionName=main Nodes={0} Default=YES State=UP
)",
                                   node, free_port(), free_port(), folder, user));
    munged_.emplace(std::vector<std::string>{
        "munged", "--force", "--foreground", "--socket=" + folder + "/munge.socket",
        "--key-file=" + folder + "/munge.key", "--pid-file=" + folder + "/munged.pid",
        "--log-file=" + folder + "/munged.log", "--seed-file=" + folder + "/munged.seed"});
    wait_for([&] { return std::filesystem::exists(folder_ / "munge.socket"); }, "munged");
    controller_.emplace(std::vector<std::string>{"slurmctld", "-D", "-f", conf()}, environment());
    wait_for([&] { return ask({"scontrol", "ping"}).out.find("is UP") != std::string::npos; }, "slurmctld");
    node_.emplace(std::vector<std::string>{"slurmd", "-D", "-f", conf(), "-N", node}, environment());
    wait_for([&] { return ask({"sinfo", "-h", "-o", "%T"}).out.starts_with("idle"); }, "slurmd");
  }
  ~Cluster() {
    ask({"scancel", "--full", "--signal=KILL", "--user", getpwuid(geteuid())->pw_name});
    ask({"scancel", "--user", getpwuid(geteuid())->pw_name});
    const Stopwatch watch;
    while (!ask({"squeue", "-h"}).out.empty() && watch.seconds() < 120)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    for (std::optional<Process>* daemon : {&node_, &controller_, &munged_}) {
      if (!*daemon) continue;
      (*daemon)->send_signal(SIGTERM);
      (*daemon)->wait(30);
    }
  }

  // The environment of programs that use this cluster.
  Environment environment() const { return {{"SLURM_CONF", conf()}}; }
  ProcessResult ask(const std::vector<std::string>& words) const {
    return run_process(words, environment(), 120);
  }

 private:
  std::string conf() const { return folder_ / "slurm.conf"; }

  static std::string host_name() {
    char name[256] = {};
    gethostname(name, sizeof name - 1);
    const std::string text = name;
    return text.substr(0, text.find('.'));
  }

  // A port that was free a moment ago.
  static int free_port() {
    const int socket_of_any = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    const bool bound = ::bind(socket_of_any, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                       ::getsockname(socket_of_any, reinterpret_cast<sockaddr*>(&address), &size) == 0;
    ::close(socket_of_any);
    if (!bound) throw std::runtime_error("no free port");
    return ntohs(address.sin_port);
  }

  template <typename Condition>
  static void wait_for(const Condition& condition, const std::string& what) {
    const Stopwatch watch;
    while (!condition()) {
      if (watch.seconds() > 600) throw std::runtime_error(what + " does not start");
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }

  TemporaryFolder folder_;
  std::optional<Process> munged_, controller_, node_;
};

}  // namespace eyeray::engine::test

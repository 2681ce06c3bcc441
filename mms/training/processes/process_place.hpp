#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace mms {

/// Where a process stands among those of a training, as its launcher says.
struct ProcessPlace {
  int rank = 0;                     ///< from 0
  int size = 1;                     ///< number of processes
  int local_rank = 0;               ///< among those of this machine
  int local_size = 1;               ///< processes of this machine, if known
  std::string address{};            ///< host of the process of rank 0
  int port = 0;                     ///< where it listens
  bool hosted_by_launcher = false;  ///< the launcher listens there itself, as torchrun does
  std::string prefix{};             ///< of names, where the launcher hosts several starts
  std::chrono::seconds wait{300};   ///< longest wait until all processes have started
  std::chrono::minutes answer{30};  ///< longest wait for the others in a step
};

/// Value of an environment variable; nullopt if it is not set or empty.
using Environment = std::function<std::optional<std::string>(const std::string&)>;

/// The environment of this process.
std::optional<std::string> environment_variable(const std::string& name);

/// Reads the variables of torchrun (RANK, WORLD_SIZE, MASTER_ADDR, MASTER_PORT), or those of
/// Slurm's srun. Without them there is one process.
/// @throws ConfigError for variables that are missing or no number in range
ProcessPlace process_place(const Environment& environment = environment_variable);

/// Cores that this process may use, if those of its machine are divided among the processes there.
int cores_of(const ProcessPlace& place);

}  // namespace mms

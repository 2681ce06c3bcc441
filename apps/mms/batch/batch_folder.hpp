#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace mms {

/// The output folder of a batch, which several processes may share:
///   runs/NAME      results of the runs that ended
///   unfinished/    results of those that go on, were killed, or failed
///   claims/        files locked by the processes that do the runs
///   failed/        files that mark runs that failed
///   logs/          output of the runs
/// and the tables of all finished runs.
class BatchFolder {
 public:
  /// Makes the folder, or takes that of an earlier batch.
  /// @throws FileError if it cannot be made, or has other files
  explicit BatchFolder(const std::filesystem::path& folder);

  /// Keeps other processes from a run until it is destroyed.
  class Claim {
   public:
    Claim(std::filesystem::path file, int descriptor)
        : file_(std::move(file)), descriptor_(descriptor) {}
    ~Claim();
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

   private:
    std::filesystem::path file_;
    int descriptor_;
  };

  /// @returns null if another process does the run
  /// @throws FileError if no file can be made
  std::unique_ptr<Claim> claim(const std::string& name) const;

  bool has_finished(const std::string& name) const;

  /// Whether the run failed after this process began.
  bool has_failed_meanwhile(const std::string& name) const;

  std::filesystem::path results(const std::string& name) const { return folder_ / "runs" / name; }
  std::filesystem::path unfinished(const std::string& name) const {
    return folder_ / "unfinished" / name;
  }
  std::filesystem::path log(const std::string& name) const {
    return folder_ / "logs" / (name + ".txt");
  }

  /// Makes the results of a run those of a finished one.
  void finish(const std::string& name) const;

  /// Marks a run as failed.
  void fail(const std::string& name) const;

  /// Whether the run failed, and was not finished since.
  bool has_failed(const std::string& name) const;

  /// The last line of a run's output.
  std::string last_words(const std::string& name) const;

  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path failure(const std::string& name) const { return folder_ / "failed" / name; }

  std::filesystem::path folder_;
  std::filesystem::file_time_type begin_;  ///< by the clock of the folder's file system
};

}  // namespace mms

#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "flight/command_line/subcommand.h"

namespace spdlog {
class logger;
}

namespace saker::flight {

/// The folder OUT of a command: made when it is not there, with the log of the run in OUT/log.txt.
/// Throws Error where it cannot be written, or where it holds results and --force was not given;
/// with --force files of the same name are replaced, others stay.
class OutputFolder {
 public:
  explicit OutputFolder(const CommonOptions& common);
  ~OutputFolder();  ///< closes the log
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  /// A folder inside, made when it is not there.
  std::filesystem::path folder(const std::string& name) const;

 private:
  std::filesystem::path path_;
};

/// Whether OUT holds an interrupted run of the same that may go on: `manifest` in OUT/`file`.
[[nodiscard]] bool goes_on(const CommonOptions& common, const std::string& file,
                           const std::string& manifest);

/// The log of one of several runs: into folder/log.txt only, so that the lines of runs that go side
/// by side do not mix. Makes the folder; throws Error where it cannot.
[[nodiscard]] std::shared_ptr<spdlog::logger> log_of_run(const std::filesystem::path& folder);

/// The file OUT of a command: `file`, if it may be written. Throws Error where it is there and
/// `force` is false, or where its folder is not there.
[[nodiscard]] std::filesystem::path output_file(const std::filesystem::path& file, bool force);

/// Logging of the process: one line an event to stderr, debug with `verbose`.
void start_logging(bool verbose);

}  // namespace saker::flight

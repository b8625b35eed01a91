#include "flight/command_line/output.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <fstream>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::flight {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLog = "log.txt";
constexpr const char* kLogPattern = "%Y-%m-%d %H:%M:%S.%e %l %v";

/// A log, or what an interrupted run left unfinished, is not a result.
bool is_result(const fs::path& file) {
  return file.filename() != kLog && file.extension() != ".part";
}

bool holds_results(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_result(entry.path())) return true;
  }
  return false;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder)) return;
  throw Error(fmt::format("cannot make the folder {}: {}", folder.string(),
                          error ? error.message() : "a file of that name is there"));
}

void check_writable(const fs::path& folder) {
  const fs::path probe = folder / ".probe.part";
  if (!std::ofstream(probe)) throw Error(fmt::format("cannot write into {}", folder.string()));
  std::error_code ignored;
  fs::remove(probe, ignored);
}

spdlog::sink_ptr log_file(const fs::path& folder) {
  auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>((folder / kLog).string(), true);
  sink->set_pattern(kLogPattern);
  return sink;
}

}  // namespace

OutputFolder::OutputFolder(const CommonOptions& common) : path_(common.out) {
  make_folder(path_);
  if (!common.force && holds_results(path_)) {
    throw Error(fmt::format("{} holds results: name another folder, or --force to replace them",
                            path_.string()));
  }
  check_writable(path_);
  spdlog::default_logger()->sinks().push_back(log_file(path_));
}

OutputFolder::~OutputFolder() {
  spdlog::default_logger()->flush();
  spdlog::default_logger()->sinks().pop_back();
}

fs::path OutputFolder::folder(const std::string& name) const {
  make_folder(path_ / name);
  return path_ / name;
}

bool goes_on(const CommonOptions& common, const std::string& file, const std::string& manifest) {
  const fs::path before = fs::path(common.out) / file;
  return !common.force && fs::exists(before) && core::read_file(before) == manifest;
}

std::shared_ptr<spdlog::logger> log_of_run(const fs::path& folder) {
  make_folder(folder);
  auto logger = std::make_shared<spdlog::logger>("run", log_file(folder));
  logger->set_level(spdlog::default_logger()->level());
  return logger;
}

fs::path output_file(const fs::path& file, bool force) {
  if (fs::is_directory(file)) throw Error(fmt::format("{} is a folder", file.string()));
  if (fs::exists(file) && !force) {
    throw Error(
        fmt::format("{} is there: name another file, or --force to replace it", file.string()));
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) {
    throw Error(fmt::format("cannot write {}: no folder {}", file.string(), folder.string()));
  }
  return file;
}

void start_logging(bool verbose) {
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  sink->set_pattern("%^%l%$: %v");
  auto logger = std::make_shared<spdlog::logger>("saker", std::move(sink));
  logger->set_level(verbose ? spdlog::level::debug : spdlog::level::info);
  logger->flush_on(spdlog::level::warn);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace saker::flight

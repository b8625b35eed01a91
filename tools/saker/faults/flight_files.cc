#include "tools/saker/faults/flight_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/exchange/durable.h"
#include "saker/objects/map_io.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kPeriod_s = 2;
constexpr std::array kNames = {"map.json", "map.smap", "newest"};
const exchange::StreamId kStream{"R1", exchange::StreamKind::history, 1};

fs::path part_of(const fs::path& file) { return file.string() + ".part"; }

/// While this lives, the disk has no room for files in the making.
class FullDisk {
 public:
  explicit FullDisk(const fs::path& folder) : folder_(folder) {
    for (const char* name : kNames) {
      fs::remove(part_of(folder_ / name));
      fs::create_symlink("/dev/full", part_of(folder_ / name));
    }
  }
  ~FullDisk() {
    std::error_code ignored;
    for (const char* name : kNames) fs::remove(part_of(folder_ / name), ignored);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  fs::path folder_;
};

}  // namespace

FlightFiles::FlightFiles(fs::path folder, const FaultSchedule& schedule,
                         const objects::ClassTable& table)
    : folder_(std::move(folder)), schedule_(schedule), table_(table), rng_(13) {
  std::error_code error;
  fs::remove_all(folder_, error);
  fs::create_directories(folder_, error);
  if (error) throw Error(fmt::format("cannot make {}: {}", folder_.string(), error.message()));
  journal_ = std::make_unique<exchange::JournalStore>(folder_ / "journal");
}

FlightFiles::~FlightFiles() {
  journal_.reset();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::vector<std::string> FlightFiles::write(double t_s, const objects::ObjectMap& map) {
  if (t_s < next_s_) return {};
  const auto acts = [&](FaultPlace place) {
    return acting(schedule_, FaultKind::disk, place, t_s);
  };
  const Fault* slow = acts(FaultPlace::slow);
  next_s_ = t_s + (slow != nullptr ? std::max(slow->strength, kPeriod_s) : kPeriod_s);
  if (acts(FaultPlace::cut) != nullptr) lose_power();
  std::optional<FullDisk> full;
  if (acts(FaultPlace::full) != nullptr) full.emplace(folder_);
  write_all(t_s, map);
  return torn(objects_);
}

void FlightFiles::write_all(double t_s, const objects::ObjectMap& map) {
  bool all = true;
  const auto wrote = [&](const char* name) { whole_[name] = core::read_file(folder_ / name); };
  for (const char* name : {"map.json", "map.smap"}) {
    try {
      objects::write_map(folder_ / name, map, table_);
      wrote(name);
      objects_ = map.objects.size();
    } catch (const Error&) {
      all = false;
    }
  }
  const std::string newest = fmt::format("{:.2f}\n", t_s);
  if (exchange::write_durably(folder_ / "newest", newest))
    wrote("newest");
  else
    all = false;
  append(t_s);
  ++(all ? written_ : failed_);
}

void FlightFiles::append(double t_s) {
  const std::string line = fmt::format("{:.2f} s\n", t_s);
  sure_ = said_.size();
  if (journal_->append(kStream, line)) said_ += line;
}

/// And comes again.
void FlightFiles::lose_power() {
  for (const auto& [name, content] : whole_)
    core::write_file(part_of(folder_ / name), content.substr(0, content.size() / 2));
  journal_.reset();
  const fs::path file = folder_ / "journal";
  const auto bytes = static_cast<int>(fs::file_size(file));
  const int record = static_cast<int>(said_.size() - sure_);  // no shorter on the disk
  fs::resize_file(file, static_cast<std::uintmax_t>(bytes - rng_.index(record + 1)));
  journal_ = std::make_unique<exchange::JournalStore>(file);
  const std::string held = journal_->bytes(kStream);
  if (held.size() >= sure_ && said_.starts_with(held)) said_ = held;
  sure_ = said_.size();
}

std::vector<std::string> FlightFiles::torn(std::size_t objects) const {
  std::vector<std::string> list;
  for (const auto& [name, content] : whole_) {
    if (core::read_file(folder_ / name) != content)
      list.push_back(fmt::format("{} is not what was written to it", name));
  }
  for (const char* name : {"map.json", "map.smap"}) {
    if (!whole_.contains(name)) continue;
    try {
      const std::size_t read = objects::read_map(folder_ / name, table_).objects.size();
      if (read != objects)
        list.push_back(fmt::format("{} holds {} objects of {}", name, read, objects));
    } catch (const Error& error) {
      list.emplace_back(error.what());
    }
  }
  if (journal_->bytes(kStream) != said_)
    list.emplace_back("the journal is not what was said to it");
  return list;
}

}  // namespace saker::tools

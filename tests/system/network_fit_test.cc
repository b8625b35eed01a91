#include "tools/saker/replay/network_fit.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "paths.h"
#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

class NetworkFit : public ::testing::Test {
 protected:
  ~NetworkFit() override { fs::remove(file_); }

  fs::path described(const std::string& text) {
    core::write_file(file_, text);
    return file_;
  }

  fs::path file_ = fs::path(::testing::TempDir()) / "saker_network_fit.yaml";
};

constexpr const char* kBounds =
    "classes: [other]\nfit:\n  least_probability: 0.8\n  least_classified_share: 0.5\n";

TEST_F(NetworkFit, IsNoNoteWhereTheNetworkIsAsSureAsOfItsOwn) {
  EXPECT_EQ(network_fit_note({.probability = 0.81, .classified_share = 0.51}, described(kBounds)),
            "");
}

TEST_F(NetworkFit, IsALineWithBothFiguresAndTheirBounds) {
  for (const autonomy::SegmentationFit fit :
       {autonomy::SegmentationFit{0.79, 0.7}, autonomy::SegmentationFit{0.9, 0.4}}) {
    const std::string note = network_fit_note(fit, described(kBounds));
    EXPECT_NE(note.find("does not fit"), std::string::npos);
    EXPECT_NE(note.find("expected 50 % and 0.80"), std::string::npos) << note;
    EXPECT_EQ(note.find('\n'), std::string::npos);
  }
}

TEST_F(NetworkFit, OfNoScanOrWithoutBoundsIsEmpty) {
  EXPECT_EQ(network_fit_note({}, described(kBounds)), "");
  EXPECT_EQ(
      network_fit_note({.probability = 0, .classified_share = 0}, described("classes: [other]\n")),
      "");
}

TEST_F(NetworkFit, BoundsThatAreNoNumbersAreNamed) {
  EXPECT_THROW((void)network_fit_note({}, described("fit:\n  least_probability: a\n")), Error);
}

TEST_F(NetworkFit, TheShippedNetworkHasItsBounds) {
  const fs::path shipped = fs::path(source_dir()) / "configs/models/segmentation.yaml";
  EXPECT_NE(network_fit_note({.probability = 0, .classified_share = 0}, shipped), "");
  EXPECT_EQ(network_fit_note({.probability = 1, .classified_share = 1}, shipped), "");
}

}  // namespace
}  // namespace saker::tools

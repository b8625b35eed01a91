#include "saker/uncertainty/covariate.h"

#include <gtest/gtest.h>

namespace saker::uncertainty {
namespace {

TEST(Covariate, IsReadFromTheView) {
  const View view{7, 0.5, 0.3, 42};
  EXPECT_EQ(value_of(view, Covariate::elevation), 0.3);
  EXPECT_EQ(value_of(view, Covariate::reflectivity), 42);
}

TEST(Covariate, HasANameAValue) {
  EXPECT_EQ(enum_names(Covariate{}), (std::vector<std::string>{"elevation", "reflectivity"}));
}

TEST(Standardised, IsCountedInSpreadsFromTheMean) {
  EXPECT_NEAR(standardised(0.7, 0.3, 0.2), 2, 1e-12);
  EXPECT_NEAR(standardised(0.1, 0.3, 0.2), -1, 1e-12);
  EXPECT_EQ(standardised(0.3, 0.3, 0.2), 0);
}

TEST(Standardised, DoesNotDependOnTheUnit) {
  EXPECT_NEAR(standardised(70, 30, 20), standardised(0.7, 0.3, 0.2), 1e-12);
}

TEST(Standardised, IsHeldWithinWhatWasFlown) {
  EXPECT_EQ(standardised(100, 0, 1), -standardised(-100, 0, 1));
  EXPECT_EQ(standardised(100, 0, 1), standardised(1000, 0, 1));
  EXPECT_LT(standardised(100, 0, 1), 4);
}

TEST(Standardised, OfWhatIsUnknownIsTheMean) {
  EXPECT_EQ(standardised(NAN, 0.3, 0.2), 0);
  EXPECT_EQ(standardised(INFINITY, 0.3, 0.2), 0);
  EXPECT_EQ(standardised(0.7, 0.3, NAN), 0);
  EXPECT_EQ(standardised(0.7, 0.3, 0), 0) << "all samples were alike";
}

}  // namespace
}  // namespace saker::uncertainty

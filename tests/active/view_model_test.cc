#include "saker/active/belief/view_model.h"

#include <gtest/gtest.h>

namespace saker::active {
namespace {

const objects::ClassTable kTable;
TEST(ViewModel, ATargetClassThatTheModelDoesNotKnowIsRefused) {
  EXPECT_ANY_THROW((void)view_model_of(std::make_shared<const uncertainty::Model>(), {}, kTable));
}

}  // namespace
}  // namespace saker::active

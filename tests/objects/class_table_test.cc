#include "saker/objects/class_table.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"

namespace saker::objects {
namespace {

TEST(ClassTable, MergesLabelsAndWritesTheFirst) {
  const ClassTable table;
  for (const std::uint32_t label : {10U, 13U, 18U, 20U, 252U, 257U, 258U, 259U}) {
    EXPECT_EQ(table[table.of_label(label)].name, "vehicle") << label;
  }
  EXPECT_EQ(table.of_label(81), 0);
  EXPECT_EQ(table.label_of(table.find("vehicle")), 10U);
  EXPECT_EQ(table.label_of(0), 99U);
  EXPECT_EQ(table.of_label(table.label_of(0)), 0);
}

TEST(ClassTable, ShippedVehiclesHaveKindsThatAreAllOfThem) {
  const ClassTable table;
  const ObjectClass& vehicle = table[table.first_target()];
  EXPECT_EQ(vehicle.name, "vehicle");
  double sum = 0;
  for (const ObjectKind& kind : vehicle.kinds) {
    sum += kind.share;
    EXPECT_EQ(kind.length_m.size(), 2U) << kind.name;
    EXPECT_GT(kind.length_m[0], kind.width_m[0]) << kind.name;
  }
  EXPECT_NEAR(sum, 1, 1e-9);
}

TEST(ClassTable, WithoutATargetThereIsNoFirst) {
  ClassTable table;
  for (ObjectClass& c : table.classes) c.target = false;
  EXPECT_EQ(table.first_target(), 0);
}

TEST(ClassTable, UnknownNameIsNamedWithTheKnownOnes) {
  try {
    (void)ClassTable{}.find("lorry");
    FAIL();
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("lorry"), std::string::npos);
    EXPECT_NE(line.find("other, vehicle, trunk, pole, ground"), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::objects

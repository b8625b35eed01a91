#include "saker/simulation/world/two_wheeler.h"

#include <gtest/gtest.h>

#include <set>

#include "saker/simulation/world/person.h"

namespace saker::simulation {
namespace {

struct Drawn {
  Eigen::AlignedBox3f box;
  std::set<std::uint16_t> labels;
};

Drawn measured(const World& world) {
  Drawn d;
  for (const Eigen::Vector3f& p : world.mesh.vertices) d.box.extend(p);
  for (const MaterialId m : world.mesh.materials) d.labels.insert(world.materials[m].label);
  return d;
}

Drawn draw(TwoWheeler kind, bool ridden, std::uint64_t seed) {
  World world;
  core::Rng rng(seed);
  const Palette palette = make_palette(world, rng);
  add_two_wheeler(world, palette, kind, SE3::Identity(), ridden, rng);
  return measured(world);
}

/// Without who rides and without a lean; from 125 cm³ scooters to tourers, children's bicycles
/// left out.
TEST(TwoWheeler, SizesAreThoseThatAreSold) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Drawn motorcycle = draw(TwoWheeler::motorcycle, false, seed);
    EXPECT_GT(motorcycle.box.sizes().x(), 1.9);
    EXPECT_LT(motorcycle.box.sizes().x(), 2.5);
    const Drawn scooter = draw(TwoWheeler::scooter, false, seed);
    EXPECT_GT(scooter.box.sizes().x(), 1.6);
    EXPECT_LT(scooter.box.sizes().x(), 2.1);
    const Drawn bicycle = draw(TwoWheeler::bicycle, false, seed);
    EXPECT_GT(bicycle.box.sizes().x(), 1.5);
    EXPECT_LT(bicycle.box.sizes().x(), 1.95);
  }
}

TEST(TwoWheeler, ItStandsOnTheGround) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_NEAR(draw(TwoWheeler::motorcycle, false, seed).box.min().z(), 0, 0.06);
    EXPECT_NEAR(draw(TwoWheeler::bicycle, true, seed).box.min().z(), 0, 0.06);
  }
}

TEST(TwoWheeler, RidersAreNotPeopleOnFoot) {
  using Labels = std::set<std::uint16_t>;
  EXPECT_EQ(draw(TwoWheeler::scooter, true, 1).labels, (Labels{kMotorcycle, kMotorcyclist}));
  EXPECT_EQ(draw(TwoWheeler::bicycle, true, 1).labels, (Labels{kBicycle, kBicyclist}));
  EXPECT_EQ(draw(TwoWheeler::bicycle, false, 1).labels, (Labels{kBicycle}));
}

TEST(Person, PassersByAreAsTallAsChildrenAndAdults) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    World world;
    core::Rng rng(seed);
    add_passer_by(world, SE3::Identity(), rng);
    const Drawn d = measured(world);
    EXPECT_GT(d.box.max().z(), 0.85) << seed;
    EXPECT_LT(d.box.max().z(), 2.4) << seed;  // under an umbrella
    EXPECT_NEAR(d.box.min().z(), 0, 0.05) << seed;
    EXPECT_EQ(d.labels, (std::set<std::uint16_t>{kPerson}));
  }
}

}  // namespace
}  // namespace saker::simulation

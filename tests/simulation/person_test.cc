#include "saker/simulation/world/person.h"

#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/simulation/world/two_wheeler.h"

namespace saker::simulation {
namespace {

struct Someone : Sketch {
  Someone(Posture posture, double height, double seat, std::uint64_t seed) : Sketch(seed) {
    draw_person(pen(), posture, height, seat, random_clothes(world, kPerson, rng), rng);
  }
};

TEST(DrawPerson, IsAsTallAsAsked) {
  for (const Posture posture : {Posture::standing, Posture::walking, Posture::child}) {
    for (const double height : {1.1, 1.6, 1.9}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Someone person(posture, height, 0, seed);
        EXPECT_NEAR(box_of(person.mesh()).max().z(), height, 0.05 * height);
        EXPECT_NEAR(box_of(person.mesh()).min().z(), 0, 0.04);
      }
    }
  }
}

TEST(DrawPerson, WalkingTheFeetAreFartherApartThanStanding) {
  Spread standing, walking;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    standing.add(box_of(Someone(Posture::standing, 1.7, 0, seed).mesh()).sizes().x());
    walking.add(box_of(Someone(Posture::walking, 1.7, 0, seed).mesh()).sizes().x());
  }
  EXPECT_GT(walking.mean(), standing.mean() + 0.15);
}

TEST(DrawPerson, SittingTheHeadIsAboveTheSeat) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Someone person(Posture::seated, 1.8, 0.5, seed);
    EXPECT_NEAR(box_of(person.mesh()).max().z(), 0.5 + 0.47 * 1.8, 0.06);
    EXPECT_GT(box_of(person.mesh()).max().x(), 0.3) << "knees and feet are ahead";
  }
}

TEST(DrawPerson, ARidersFeetAreOffTheGround) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    EXPECT_GT(box_of(Someone(Posture::riding, 1.75, 1, seed).mesh()).min().z(), 0.1);
}

TEST(DrawPerson, IsNarrowerThanADoor) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_LT(box_of(Someone(Posture::standing, 1.9, 0, seed).mesh()).sizes().y(), 0.85);
}

TEST(RandomClothes, AreOfTheLabelThatIsAskedFor) {
  for (const std::uint16_t label : {kPerson, kBicyclist, kMotorcyclist}) {
    Sketch s;
    const Clothes c = random_clothes(s.world, label, s.rng);
    for (const MaterialId m : {c.coat, c.trousers, c.skin, c.gear})
      EXPECT_EQ(s.world.materials[m].label, label);
    EXPECT_GE(s.world.materials[c.skin].reflectivity, 0.25F);
  }
}

TEST(PasserBy, IsAPersonWithWhateverTheyHave) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Sketch s(seed);
    add_passer_by(s.world, SE3::Identity(), s.rng);
    EXPECT_EQ(labels_of(s.world, s.mesh()), std::set<int>{kPerson});
    EXPECT_TRUE(s.world.objects.empty());
  }
}

TEST(PasserBy, StaysWithinTwoMetres) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Sketch s(seed);
    add_passer_by(s.world, SE3::Identity(), s.rng);
    for (const Eigen::Vector3f& p : s.mesh().vertices) ASSERT_LT(p.head<2>().norm(), 1.5F) << seed;
    EXPECT_GT(box_of(s.mesh()).min().z(), -0.05) << seed;
  }
}

TEST(Sitters, SitOnTheirWall) {
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    Sketch s(seed);
    add_sitters(s.world, s.palette, SE3::Identity(), s.rng);
    const Eigen::AlignedBox3d wall = box_of_label(s.world, kOtherStructure);
    const Eigen::AlignedBox3d people = box_of_label(s.world, kPerson);
    EXPECT_NEAR(wall.min().z(), 0, 1e-6);
    EXPECT_LE(wall.max().z(), 0.5);
    EXPECT_GT(people.max().z(), wall.max().z() + 0.7);
    EXPECT_LT(people.max().y(), wall.max().y() + 0.45);
  }
}

TEST(Rider, SitsOnTheSeat) {
  for (const TwoWheeler kind : {TwoWheeler::bicycle, TwoWheeler::scooter, TwoWheeler::motorcycle}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      Sketch s(seed);
      add_two_wheeler(s.world, s.palette, kind, SE3::Identity(), true, s.rng);
      const int rider = kind == TwoWheeler::bicycle ? kBicyclist : kMotorcyclist;
      const Eigen::AlignedBox3d box = box_of_label(s.world, rider);
      EXPECT_GT(box.max().z(), 1.45) << seed;
      EXPECT_LT(box.max().z(), 2.05) << seed;
      EXPECT_GT(box.min().z(), 0.05) << seed;
    }
  }
}

TEST(BicycleStand, StandsAcross) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Sketch s(seed);
    add_bicycle_stand(s.world, s.palette, SE3::Identity(), s.rng);
    const Eigen::AlignedBox3d box = box_of(s.mesh());
    EXPECT_GE(box.sizes().x(), 0.5) << seed;
    EXPECT_LT(box.sizes().y(), 0.06) << seed;
    EXPECT_LT(box.max().z(), 0.9) << seed;
  }
}

}  // namespace
}  // namespace saker::simulation

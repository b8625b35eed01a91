#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "saker/objects/models.h"
#include "saker/simulation/world/material.h"
#include "saker/simulation/world/mesh.h"

namespace saker::simulation {

/// What a map should hold: truth, in the world frame.
struct TrueObject {
  std::string class_name;  ///< vehicle, trunk or pole
  std::string kind;        ///< sedan, …, oak, lamp: for people
  objects::Model model;
  bool moving = false;  ///< drives: belongs to no map
};

/// A mesh that is drawn many times, in a frame of its own.
struct Placement {
  std::size_t prototype = 0;
  Eigen::Affine3f T_world_prototype = Eigen::Affine3f::Identity();
  ObjectId object = 0;
};

/// Everything that a beam can meet, z up.
struct World {
  Mesh mesh;                     ///< what stands once
  std::vector<Mesh> prototypes;  ///< crowns and bushes: thousands of leaves each
  std::vector<Placement> placements;
  std::vector<Placement> movers;  ///< where they are at the start; RayCaster::move takes them on

  std::vector<Material> materials;
  std::vector<TrueObject> objects;

  MaterialId add(const Material& material) {
    materials.push_back(material);
    return static_cast<MaterialId>(materials.size() - 1);
  }
  ObjectId add(TrueObject object) {
    objects.push_back(std::move(object));
    return static_cast<ObjectId>(objects.size());
  }
};

}  // namespace saker::simulation

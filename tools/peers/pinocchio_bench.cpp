// Times Pinocchio on the robot of a text file: one line per body, parents first,
//     parent axis_x axis_y axis_z origin_x origin_y origin_z mass com_x com_y com_z inertia_x inertia_y inertia_z
// with the parent's line number from 0, or -1 for the ground; an axis of three zeros is a free-flyer.
// Prints nanoseconds per call of RNEA, of its derivatives and of ABA: each the least mean of several turns.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <pinocchio/multibody.hpp>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

namespace pin = pinocchio;

pin::Model load(const std::string &file) {
  pin::Model model;
  std::vector<pin::JointIndex> ids;
  std::ifstream in(file);
  int parent;
  Eigen::Vector3d axis, origin, com, inertia;
  double mass;
  while (in >> parent >> axis[0] >> axis[1] >> axis[2] >> origin[0] >> origin[1] >> origin[2] >> mass >> com[0] >>
         com[1] >> com[2] >> inertia[0] >> inertia[1] >> inertia[2]) {
    const pin::SE3 place(Eigen::Matrix3d::Identity(), origin);
    const pin::JointIndex at = parent < 0 ? 0 : ids[parent];
    const std::string name = "joint" + std::to_string(ids.size());
    // As Pinocchio's own URDF parser chooses: joints along a coordinate have code of their own.
    const auto add = [&](const auto &joint) { ids.push_back(model.addJoint(at, joint, place, name)); };
    if (axis.isZero()) add(pin::JointModelFreeFlyer());
    else if (axis == Eigen::Vector3d::UnitX()) add(pin::JointModelRX());
    else if (axis == Eigen::Vector3d::UnitY()) add(pin::JointModelRY());
    else if (axis == Eigen::Vector3d::UnitZ()) add(pin::JointModelRZ());
    else add(pin::JointModelRevoluteUnaligned(axis));
    const Eigen::Matrix3d moments = inertia.asDiagonal();
    if (mass > 0) model.appendBodyToJoint(ids.back(), pin::Inertia(mass, com, moments), pin::SE3::Identity());
  }
  return model;
}

double nanoseconds(const std::function<void()> &work) {
  using clock = std::chrono::steady_clock;
  constexpr int calls = 2000, turns = 25;
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < turns; ++turn) {
    const auto begin = clock::now();
    for (int call = 0; call < calls; ++call) work();
    least = std::min(least, std::chrono::duration<double, std::nano>(clock::now() - begin).count() / calls);
  }
  return least;
}

int main(int, char **arguments) {
  for (int index = 1; index <= 2; ++index) {
    const pin::Model model = load(arguments[index]);
    pin::Data data(model);
    Eigen::VectorXd q = pin::neutral(model), v(model.nv), a(model.nv);
    for (int i = 0; i < model.nv; ++i) {
      v[i] = 2.0 * std::sin(0.7 * i);
      a[i] = 10.0 * std::sin(0.7 * i + 1.0);
    }
    q.tail(18) += Eigen::VectorXd::LinSpaced(18, -0.4, 0.4);
    if (index == 1) {
      std::printf("rnea %.1f\n", nanoseconds([&] { pin::rnea(model, data, q, v, a); }));
      std::printf("rnea_derivatives %.1f\n", nanoseconds([&] { pin::computeRNEADerivatives(model, data, q, v, a); }));
    } else {
      std::printf("aba %.1f\n", nanoseconds([&] { pin::aba(model, data, q, v, a); }));
    }
  }
}

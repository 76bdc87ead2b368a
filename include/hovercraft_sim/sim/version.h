#pragma once

#include <cstdint>
#include <string>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// Of the package, as in package.xml.
constexpr const char* kVersion = "0.2.0";

/// Raised with every change after which the same scenario and commands give other bits: with each
/// recorded hash that changes (test/determinism/hashes.txt). Recordings and snapshots carry it.
constexpr std::int64_t kPhysicsVersion = 2;

/// Of what toSnapshot() writes; a snapshot without one has format 1.
constexpr std::int64_t kSnapshotFormat = 2;

/// What programs answer to --version: "NAME of hovercraft_sim 0.2.0, physics version 2".
HOVERCRAFT_PUBLIC std::string versionText(const std::string& program);

}  // namespace hovercraft

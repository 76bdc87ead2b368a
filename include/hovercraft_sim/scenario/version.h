#pragma once

#include <cstdint>
#include <string>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// Raised with every change after which the same scenario and commands give other bits: with each
/// recorded hash that changes (test/determinism/hashes.txt). Recordings and snapshots carry it.
constexpr std::int64_t kPhysicsVersion = 3;

/// Of what toSnapshot() writes; a snapshot without one has format 1.
constexpr std::int64_t kSnapshotFormat = 2;

/// Of the package, as in package.xml.
HOVERCRAFT_PUBLIC const char* version();

/// Of the sources that this was built from: the first digits of its hash, with "-dirty" where they
/// had changes; "unknown" where there was no git, and nobody said (HOVERCRAFT_COMMIT).
HOVERCRAFT_PUBLIC const char* commit();

/// "hovercraft_sim 0.2.0 (commit 1e2f1057fe73)": what scenarios that are written name as
/// `software`.
HOVERCRAFT_PUBLIC std::string softwareText();

/// What programs answer to --version: "NAME of " softwareText() ", physics version 3".
HOVERCRAFT_PUBLIC std::string versionText(const std::string& program);

/// Prints versionText() if --version is among the arguments: for a node, which has no other
/// options.
/// @returns whether it was.
HOVERCRAFT_PUBLIC bool answersVersion(const std::string& program, int argc, char** argv);

/// Prints what a node is for and how it is called if --help or -h is among the arguments.
/// @param purpose a sentence or two.
/// @returns whether it was.
HOVERCRAFT_PUBLIC bool answersHelp(const std::string& program, const std::string& purpose, int argc,
                                   char** argv);

}  // namespace hovercraft

#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/geometry/polygon_mesh.h"

#include "files.h"

namespace hovercraft::testing {

/// The text of a mesh as an OBJ file, with 17 digits.
inline std::string objText(const PolygonMesh& mesh) {
  std::string text;
  for (const Vector3& p : mesh.vertices) {
    text += "v";
    for (int i = 0; i < 3; ++i) {
      std::array<char, 32> number{};
      std::snprintf(number.data(), number.size(), " %.17g", p[i]);
      text += number.data();
    }
    text += "\n";
  }
  for (const auto& face : mesh.faces) {
    text += "f";
    for (const int v : face) text += " " + std::to_string(v + 1);
    text += "\n";
  }
  return text;
}

/// A mesh of triangles as binary STL, with a header of 80 bytes that begins as given.
inline std::string stlBytes(const PolygonMesh& mesh, std::string header = "") {
  header.resize(80, ' ');
  std::string bytes = header;
  const auto add = [&bytes](std::uint32_t word) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>((word >> (8 * i)) & 0xffU);
  };
  add(static_cast<std::uint32_t>(mesh.faces.size()));
  for (const auto& face : mesh.faces) {
    for (int i = 0; i < 3; ++i) add(0);  // the normal
    for (const int v : face) {
      for (int i = 0; i < 3; ++i) {
        const auto number = static_cast<float>(mesh.vertices[static_cast<std::size_t>(v)][i]);
        std::uint32_t bits = 0;
        std::memcpy(&bits, &number, sizeof(bits));
        add(bits);
      }
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

/// The message of parsing a closed mesh; "no error" if it is in order.
inline std::string messageOfParsing(const std::string& content, MeshFormat format) {
  const std::string message =
      messageOf([&] { parseClosedMesh(content, format, Vector3::Ones(), "it"); });
  return message == "nothing was thrown" ? "no error" : message;
}

}  // namespace hovercraft::testing

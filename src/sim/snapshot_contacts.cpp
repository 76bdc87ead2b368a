#include "hovercraft_sim/sim/snapshot_contacts.h"

#include <array>
#include <cmath>

#include "hovercraft_sim/geometry/convex_polyhedron.h"

namespace hovercraft {
namespace {

std::int32_t index(const ConfigReader& reader, const char* key, std::int32_t least,
                   std::int32_t count) {
  return static_cast<std::int32_t>(reader.wholeNumber(key, least, std::int64_t{count} - 1));
}

/// A feature of a body, and where the search in its ring or fan starts.
struct SavedFeature {
  Feature feature;
  std::int32_t hint;
};

struct FeatureKeys {
  const char* kind;
  const char* index;
  const char* hint;
};

SavedFeature parseFeature(const ConfigReader& reader, const ConvexPolyhedron& hull,
                          const FeatureKeys& keys) {
  SavedFeature saved{};
  saved.feature.kind = static_cast<FeatureKind>(index(reader, keys.kind, 0, 3));
  const std::array<int, 3> counts = {hull.vertexCount(), hull.edgeCount(), hull.faceCount()};
  saved.feature.index =
      index(reader, keys.index, 0, counts[static_cast<std::size_t>(saved.feature.kind)]);
  std::int32_t places = 1;
  if (saved.feature.kind == FeatureKind::kVertex) {
    places = hull.data().vertices[static_cast<std::size_t>(saved.feature.index)].fan_count;
  } else if (saved.feature.kind == FeatureKind::kFace) {
    places = hull.face(saved.feature.index).ring_count;
  }
  saved.hint = index(reader, keys.hint, 0, places);
  return saved;
}

ContactCache parseContact(const ConfigReader& reader, const World& world) {
  reader.allowOnly({"a", "b", "kind_a", "index_a", "kind_b", "index_b", "hint_a", "hint_b",
                    "resting", "points"});
  const auto moving = static_cast<std::int32_t>(world.scene().bodies().size());
  const std::int32_t all = moving + static_cast<std::int32_t>(world.scene().obstacles().size());
  ContactCache contact;
  contact.a = index(reader, "a", 0, moving);
  contact.b = index(reader, "b", contact.a + 1, all);
  const SavedFeature a =
      parseFeature(reader, world.scene().hullOf(contact.a), {"kind_a", "index_a", "hint_a"});
  const SavedFeature b =
      parseFeature(reader, world.scene().hullOf(contact.b), {"kind_b", "index_b", "hint_b"});
  contact.features = {true, a.feature, b.feature, {a.hint, b.hint}};
  contact.resting = reader.flagOr(false, "resting");
  if (!reader.has("points")) return contact;
  for (const ConfigReader& point : reader.list("points")) {
    if (contact.count == ContactManifold::kMaxPoints) reader.fail("points", "must be at most 8");
    point.allowOnly({"p", "force"});
    const auto k = static_cast<std::size_t>(contact.count++);
    contact.p_AC[k] = point.vector("p");
    contact.force_B_W[k] = point.vector("force");
    if (!std::isfinite(squaredNorm(contact.p_AC[k])) ||
        !std::isfinite(squaredNorm(contact.force_B_W[k]))) {
      point.fail("", "the squares of p and force must be finite");
    }
  }
  return contact;
}

}  // namespace

std::vector<ContactCache> parseContactCaches(const ConfigReader& reader, const World* world) {
  std::vector<ContactCache> contacts;
  if (!reader.has("contacts")) return contacts;
  if (world == nullptr) reader.fail("contacts", "needs a world: in the scenario");
  for (const ConfigReader& entry : reader.list("contacts")) {
    const ContactCache contact = parseContact(entry, *world);
    const bool ascends = contacts.empty() || contacts.back().a < contact.a ||
                         (contacts.back().a == contact.a && contacts.back().b < contact.b);
    if (!ascends) entry.fail("", "pairs must stand once and in ascending order");
    contacts.push_back(contact);
  }
  return contacts;
}

}  // namespace hovercraft

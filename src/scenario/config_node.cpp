#include "hovercraft_sim/scenario/config_node.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace hovercraft {
namespace {

/// Aliases of aliases make sizes that no number holds.
std::size_t sum(std::size_t a, std::size_t b) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  return a > kMost - b ? kMost : a + b;
}

}  // namespace

ConfigNode ConfigNode::of(Content content) {
  const auto count = [&content](const ConfigNode& child) {
    content.size = sum(content.size, child.size());
    content.depth = std::max(content.depth, child.depth() + 1);
  };
  if (content.kind != Kind::kText) content.depth = 1;
  for (const ConfigNode& item : content.items) count(item);
  for (const auto& [key, value] : content.members) {
    content.size = sum(content.size, key.size() / kTextPerValue);
    count(value);
  }
  ConfigNode node;
  node.content_ = std::make_shared<const Content>(std::move(content));
  return node;
}

ConfigNode ConfigNode::ofText(std::string text, bool is_plain) {
  Content content;
  content.kind = Kind::kText;
  content.is_plain = is_plain;
  content.size = 1 + text.size() / kTextPerValue;
  content.text = std::move(text);
  return of(std::move(content));
}

ConfigNode ConfigNode::ofList(List items) {
  Content content;
  content.kind = Kind::kList;
  content.items = std::move(items);
  return of(std::move(content));
}

ConfigNode ConfigNode::ofMap(Map members) {
  Content content;
  content.kind = Kind::kMap;
  content.members = std::move(members);
  content.by_key.resize(content.members.size());
  std::iota(content.by_key.begin(), content.by_key.end(), std::size_t{0});
  std::sort(content.by_key.begin(), content.by_key.end(), [&content](std::size_t a, std::size_t b) {
    return content.members[a].first < content.members[b].first;
  });
  return of(std::move(content));
}

const ConfigNode::Content& ConfigNode::content() const {
  static const Content nothing;
  return content_ ? *content_ : nothing;
}

const ConfigNode* ConfigNode::find(const std::string& key) const {
  const std::vector<std::size_t>& by_key = content().by_key;
  const auto found = std::lower_bound(
      by_key.begin(), by_key.end(), key,
      [this](std::size_t i, const std::string& wanted) { return members()[i].first < wanted; });
  if (found == by_key.end() || members()[*found].first != key) return nullptr;
  return &members()[*found].second;
}

std::string ConfigNode::beginning(std::size_t least) const {
  std::string text;
  append(text, least);
  return text;
}

void ConfigNode::append(std::string& text, std::size_t least) const {
  if (text.size() > least) return;
  if (isText()) text += this->text();
  if (isList()) text += "[";
  for (std::size_t i = 0; i < items().size() && text.size() <= least; ++i) {
    if (i > 0) text += ", ";
    items()[i].append(text, least);
  }
  if (isList()) text += "]";
  if (isMap()) text += "{";
  const char* separator = "";
  for (const auto& [key, value] : members()) {
    if (text.size() > least) break;
    text += separator + key + ": ";
    value.append(text, least);
    separator = ", ";
  }
  if (isMap()) text += "}";
}

}  // namespace hovercraft

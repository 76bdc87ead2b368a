#include "hovercraft_sim/web/access.h"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <cstddef>

#include "hovercraft_sim/math/parse_number.h"

namespace hovercraft_ros {
namespace {

constexpr std::size_t kMostHostBytes = 255;
constexpr std::size_t kMostPortDigits = 5;
constexpr std::size_t kLeastTokenBytes = 16;
constexpr std::size_t kMostTokenBytes = 128;

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string lower(std::string_view text) {
  std::string made(text);
  for (char& c : made) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return made;
}

bool isPort(std::string_view text) {
  return !text.empty() && text.size() <= kMostPortDigits &&
         std::all_of(text.begin(), text.end(), hovercraft::isDigit);
}

/// Of a name or an address, a bracket or colon of IPv6 included.
bool isHostCharacter(char c) {
  return isLetter(c) || hovercraft::isDigit(c) || c == '.' || c == '-' || c == ':' || c == '_';
}

bool isAddress(std::string_view host) {
  const bool is_bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  const std::string text(is_bracketed ? host.substr(1, host.size() - 2) : host);
  boost::system::error_code error;
  const auto address = boost::asio::ip::make_address(text, error);
  return !error && address.is_v6() == is_bracketed;
}

bool isKnownHost(std::string_view field, const AccessRules& rules) {
  const auto host = hostWithoutPort(field);
  if (!host) return false;
  const bool is_listed =
      std::find(rules.hosts.begin(), rules.hosts.end(), *host) != rules.hosts.end();
  return *host == "localhost" || is_listed || isAddress(*host);
}

/// Whether it is a page of this server that asks. Behind a proxy that adds TLS it is one of https.
bool isOwnOrigin(std::string_view origin, std::string_view host) {
  const std::string own = lower(host);
  const std::string said = lower(origin);
  return said == "http://" + own || said == "https://" + own;
}

bool hasToken(std::string_view query, const AccessRules& rules) {
  constexpr std::string_view key = "token=";
  if (rules.token.empty()) return true;
  return query.substr(0, key.size()) == key && isToken(query.substr(key.size()), rules.token);
}

}  // namespace

std::optional<std::string> hostWithoutPort(std::string_view field) {
  if (field.empty() || field.size() > kMostHostBytes) return std::nullopt;
  const std::size_t bracket = field.front() == '[' ? field.find(']') : 0;
  if (bracket == std::string_view::npos) return std::nullopt;
  const std::size_t colon = field.find(':', bracket);
  const std::string_view host = field.substr(0, colon);
  if (colon != std::string_view::npos && !isPort(field.substr(colon + 1))) return std::nullopt;
  const std::string_view inner =
      bracket == 0 ? host : host.substr(1, std::max<std::size_t>(bracket, 1) - 1);
  const bool ends_there = bracket == 0 || host.size() == bracket + 1;
  const bool is_plain = std::all_of(inner.begin(), inner.end(), isHostCharacter);
  if (inner.empty() || !ends_there || !is_plain) return std::nullopt;
  return lower(host);
}

bool isToken(std::string_view said, std::string_view token) {
  unsigned difference = said.size() == token.size() ? 0 : 1;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char other = i < said.size() ? said[i] : '\0';
    difference |= static_cast<unsigned char>(token[i] ^ other);
  }
  return difference == 0;
}

bool isGoodToken(std::string_view token) {
  return token.size() >= kLeastTokenBytes && token.size() <= kMostTokenBytes &&
         std::all_of(token.begin(), token.end(), [](char c) {
           return isLetter(c) || hovercraft::isDigit(c) || c == '-' || c == '_';
         });
}

namespace {

/// On a request whose host and origin are right.
Verdict verdictOnTarget(const RequestHead& request, const AccessRules& rules) {
  const std::string_view target = request.target;
  const std::size_t mark = target.find('?');
  const std::string_view path = target.substr(0, mark);
  const std::string_view query =
      mark == std::string_view::npos ? std::string_view() : target.substr(mark + 1);
  const bool is_get = request.method == "GET";
  if (path == "/socket") {
    if (!is_get) return Verdict::kWrongMethod;
    if (!request.is_upgrade) return Verdict::kBadRequest;
    return hasToken(query, rules) ? Verdict::kSocket : Verdict::kWrongToken;
  }
  if (path != "/" && path != "/report.js") return Verdict::kNotFound;
  if (!is_get && request.method != "HEAD") return Verdict::kWrongMethod;
  return path == "/" ? Verdict::kPage : Verdict::kScript;
}

}  // namespace

Verdict verdictOn(const RequestHead& request, const AccessRules& rules) {
  if (request.hosts.size() != 1 || request.origins.size() > 1) return Verdict::kBadRequest;
  const std::string& host = request.hosts.front();
  if (!isKnownHost(host, rules)) return Verdict::kWrongHost;
  if (!request.origins.empty() && !isOwnOrigin(request.origins.front(), host)) {
    return Verdict::kWrongOrigin;
  }
  return verdictOnTarget(request, rules);
}

}  // namespace hovercraft_ros

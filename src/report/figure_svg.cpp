#include <fmt/format.h>

#include "hovercraft_sim/report/figure.h"

namespace hovercraft_ros {
namespace {

std::string colorText(const FigureColor& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
}

/// XML has no control characters, escaped or not.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char character : text) {
    const auto code = static_cast<unsigned char>(character);
    const bool is_special = character == '<' || character == '>' || character == '&' ||
                            character == '"' || character == '\'';
    if (is_special) {
      safe += fmt::format("&#{};", code);
    } else {
      safe += code < 0x20 || code == 0x7f ? '?' : character;
    }
  }
  return safe;
}

std::string pointsText(const std::vector<FigurePoint>& points) {
  std::string text;
  for (const FigurePoint& point : points) text += fmt::format("{:.2f},{:.2f} ", point.x, point.y);
  return text;
}

const char* anchorText(FigureAnchor anchor) {
  if (anchor == FigureAnchor::kBegin) return "start";
  return anchor == FigureAnchor::kMiddle ? "middle" : "end";
}

std::string textElement(const FigureText& text) {
  const std::string turn = text.is_upright ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"",
                                                         text.place.x, text.place.y)
                                           : "";
  return fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\"{}>{}"
      "</text>\n",
      text.place.x, text.place.y, text.size, anchorText(text.anchor), colorText(text.color), turn,
      escaped(text.text));
}

}  // namespace

std::string svgOf(const Figure& figure) {
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', "
      "sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      figure.width, figure.height);
  for (const FigureArea& area : figure.areas) {
    svg += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", pointsText(area.corners),
                       colorText(area.color));
  }
  for (const FigureLine& line : figure.lines) {
    const std::string dash =
        line.dash > 0.0 ? fmt::format(" stroke-dasharray=\"{:.1f}\"", line.dash) : "";
    svg += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" "
        "stroke-linejoin=\"round\"{}/>\n",
        pointsText(line.points), colorText(line.color), line.width, dash);
  }
  for (const FigureText& text : figure.texts) svg += textElement(text);
  return svg + "</svg>\n";
}

}  // namespace hovercraft_ros

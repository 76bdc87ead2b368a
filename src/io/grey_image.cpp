#include "hovercraft_sim/io/grey_image.h"

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <fmt/format.h>
#include <png.h>
#include <stdexcept>

namespace hovercraft {
namespace {

[[noreturn]] void refuse(const std::string& rule) {
  throw std::invalid_argument(rule);
}

void checkSize(std::size_t columns, std::size_t rows) {
  if (columns < 2 || rows < 2) refuse("the image must have at least 2 by 2 pixels");
  if (columns > kMostPixels || rows > kMostPixels || columns * rows > kMostPixels) {
    refuse(fmt::format("the image has more than {} pixels", kMostPixels));
  }
}

/// The head of a PGM file, and the values of one of kind P2, are numbers with white space and
/// comments between them.
class PgmText {
 public:
  explicit PgmText(const std::string& bytes) : bytes_(bytes) {}

  /// The next whole number. @param most bound on it.
  std::uint32_t number(std::uint32_t most) {
    skip();
    std::uint32_t value = 0;
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9') {
      value = value * 10 + static_cast<std::uint32_t>(bytes_[at_++] - '0');
      if (value > most) refuse(fmt::format("a number in the PGM file is greater than {}", most));
    }
    if (at_ == begin) refuse("the PGM file ends early, or has something else than a number");
    return value;
  }
  std::size_t place() const { return at_; }

 private:
  static bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
  }
  void skip() {
    while (at_ < bytes_.size() && (isSpace(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] != '#') {
        ++at_;
        continue;
      }
      while (at_ < bytes_.size() && bytes_[at_] != '\n' && bytes_[at_] != '\r') ++at_;
    }
  }

  const std::string& bytes_;
  std::size_t at_ = 2;  // behind P2 or P5
};

void checkPixels(const GreyImage& image) {
  for (const std::uint16_t pixel : image.pixels) {
    if (pixel > image.most) refuse(fmt::format("a pixel is greater than {}", image.most));
  }
}

GreyImage pgmOf(const std::string& bytes) {
  constexpr std::uint32_t kMostValue = 65535;
  PgmText text(bytes);
  GreyImage image;
  image.columns = text.number(kMostPixels);
  image.rows = text.number(kMostPixels);
  checkSize(image.columns, image.rows);
  image.most = text.number(kMostValue);
  if (image.most == 0) refuse("the greatest value of a PGM file must not be 0");
  const std::size_t count = image.columns * image.rows;
  image.pixels.resize(count);
  if (bytes[1] == '2') {
    for (std::uint16_t& pixel : image.pixels) {
      pixel = static_cast<std::uint16_t>(text.number(kMostValue));
    }
    checkPixels(image);
    return image;
  }
  const std::size_t begin = text.place() + 1;  // one white space behind the head
  const std::size_t width = image.most > 255 ? 2 : 1;
  if (begin > bytes.size() || bytes.size() - begin < width * count) {
    refuse("the PGM file ends early");
  }
  const auto byte_at = [&](std::size_t i) {
    return static_cast<unsigned int>(static_cast<unsigned char>(bytes[begin + i]));
  };
  for (std::size_t i = 0; i < count; ++i) {
    image.pixels[i] = static_cast<std::uint16_t>(
        width == 1 ? byte_at(i) : (byte_at(2 * i) << 8U) | byte_at(2 * i + 1));
  }
  checkPixels(image);
  return image;
}

/// What libpng reads from, and what it says when it fails.
struct PngInput {
  const std::string* bytes;
  std::size_t at;
  char message[100];
};

extern "C" {

void readPngBytes(png_structp png, png_bytep to, std::size_t count) {
  auto* input = static_cast<PngInput*>(png_get_io_ptr(png));
  if (count > input->bytes->size() - input->at) png_error(png, "the file ends early");
  std::memcpy(to, input->bytes->data() + input->at, count);
  input->at += count;
}

void keepPngMessage(png_structp png, png_const_charp message) {
  auto* input = static_cast<PngInput*>(png_get_error_ptr(png));
  std::strncpy(input->message, message, sizeof(input->message) - 1);
  png_longjmp(png, 1);
}

void ignorePngWarning(png_structp /*png*/, png_const_charp /*message*/) {}

}  // extern "C"

/// What is read of a PNG file; made before libpng may jump, so that nothing is left behind then.
struct PngRead {
  png_structp png = nullptr;
  png_infop info = nullptr;
  PngInput input = {nullptr, 0, {}};
  std::vector<png_byte> bytes;
  std::vector<png_bytep> rows;
  bool is_grey = false;
  bool is_small = true;
  std::size_t columns = 0;
  std::size_t row_count = 0;
  unsigned int depth = 0;

  PngRead() = default;
  PngRead(const PngRead&) = delete;
  PngRead& operator=(const PngRead&) = delete;
  ~PngRead() { png_destroy_read_struct(&png, &info, nullptr); }
};

/// Asks libpng for size and kind. @returns false if it fails.
bool readHead(PngRead& read) {
  // NOLINTNEXTLINE(cert-err52-cpp): libpng's way to report errors.
  if (setjmp(png_jmpbuf(read.png)) != 0) return false;
  png_read_info(read.png, read.info);
  read.is_grey = png_get_color_type(read.png, read.info) == PNG_COLOR_TYPE_GRAY &&
                 png_get_valid(read.png, read.info, PNG_INFO_tRNS) == 0;
  read.columns = png_get_image_width(read.png, read.info);
  read.row_count = png_get_image_height(read.png, read.info);
  read.depth = png_get_bit_depth(read.png, read.info);
  if (read.depth < 8) png_set_expand_gray_1_2_4_to_8(read.png);
  png_set_interlace_handling(read.png);
  png_read_update_info(read.png, read.info);
  return true;
}

bool readRows(PngRead& read) {
  // NOLINTNEXTLINE(cert-err52-cpp)
  if (setjmp(png_jmpbuf(read.png)) != 0) return false;
  png_read_image(read.png, read.rows.data());
  return true;
}

GreyImage pngOf(const std::string& bytes) {
  PngRead read;
  read.input.bytes = &bytes;
  read.png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &read.input, keepPngMessage, ignorePngWarning);
  if (read.png != nullptr) read.info = png_create_info_struct(read.png);
  if (read.info == nullptr) refuse("libpng does not start");
  png_set_read_fn(read.png, &read.input, readPngBytes);
  const auto fail = [&] { refuse(fmt::format("the PNG file is damaged: {}", read.input.message)); };
  if (!readHead(read)) fail();
  if (!read.is_grey) refuse("the PNG file must be grey, without colours, palette or transparency");
  checkSize(read.columns, read.row_count);
  const std::size_t width = read.depth == 16 ? 2 : 1;
  read.bytes.resize(width * read.columns * read.row_count);
  for (std::size_t row = 0; row < read.row_count; ++row) {
    read.rows.push_back(read.bytes.data() + width * read.columns * row);
  }
  if (!readRows(read)) fail();
  GreyImage image = {read.columns, read.row_count, width == 2 ? 65535U : 255U, {}};
  image.pixels.resize(read.columns * read.row_count);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<std::uint16_t>(
        width == 1 ? read.bytes[i] : (read.bytes[2 * i] << 8U) | read.bytes[2 * i + 1]);
  }
  return image;
}

}  // namespace

GreyImage greyImageOf(const std::string& bytes) {
  if (bytes.size() > kMostImageBytes) {
    refuse(fmt::format("the image has more than {} bytes", kMostImageBytes));
  }
  if (bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == '2' || bytes[1] == '5')) {
    return pgmOf(bytes);
  }
  if (bytes.rfind("\x89PNG", 0) == 0) return pngOf(bytes);
  refuse("is no PGM (P2, P5) and no PNG file");
}

}  // namespace hovercraft

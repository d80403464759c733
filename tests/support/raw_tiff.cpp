#include "tests/support/raw_tiff.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

namespace farhorizon {

namespace {

class Writer {
 public:
  Writer(bool big_endian, bool big_tiff) : big_endian_(big_endian), big_tiff_(big_tiff) {}

  std::string Write(const std::vector<RawImage>& images) {
    bytes_ = std::string(2, big_endian_ ? 'M' : 'I');
    bytes_ += Number(big_tiff_ ? 43 : 42, 2);
    if (big_tiff_) bytes_ += Number(8, 2) + Number(0, 2);
    std::size_t link = bytes_.size();
    bytes_ += Number(0, place_bytes());
    for (const RawImage& image : images) link = WriteImage(image, link);
    return bytes_;
  }

 private:
  [[nodiscard]] std::size_t place_bytes() const { return big_tiff_ ? 8 : 4; }

  [[nodiscard]] std::string Number(std::uint64_t value, std::size_t count) const {
    std::string bytes(count, '\0');
    for (std::size_t i = 0; i < count; ++i) {
      bytes[big_endian_ ? count - 1 - i : i] = static_cast<char>(value >> (8 * i));
    }
    return bytes;
  }

  // Rows of samples, the highest bit first, each row from a byte of its own.
  [[nodiscard]] std::string Samples(const RawImage& image) const {
    if (image.bits % 8 == 0 && image.bits != 24) {  // those of 24 as GDAL writes them
      std::string bytes;
      for (const double sample : image.samples) {
        bytes += Number(static_cast<std::uint64_t>(static_cast<std::int64_t>(sample)),
                        static_cast<std::size_t>(image.bits / 8));
      }
      return bytes;
    }
    std::string bytes;
    for (std::size_t i = 0; i < image.samples.size(); ++i) {
      if (i % static_cast<std::size_t>(image.columns) == 0) bit_ = 8;
      const auto sample = static_cast<std::int64_t>(image.samples[i]);
      for (int b = image.bits - 1; b >= 0; --b) {
        if (bit_ == 8) {
          bytes += '\0';
          bit_ = 0;
        }
        if ((sample >> b & 1) != 0) bytes.back() = static_cast<char>(bytes.back() | 0x80 >> bit_);
        ++bit_;
      }
    }
    return bytes;
  }

  [[nodiscard]] std::string Values(const RawTag& tag) const {
    if (tag.type == 2) return tag.text + '\0';
    std::string bytes;
    for (const double value : tag.numbers) {
      switch (tag.type) {
        case 3:
          bytes += Number(static_cast<std::uint64_t>(value), 2);
          break;
        case 4:
          bytes += Number(static_cast<std::uint64_t>(value), 4);
          break;
        case 12:
          bytes += Number(std::bit_cast<std::uint64_t>(value), 8);
          break;
        default:
          throw std::runtime_error("RawTag of a type that is not written");
      }
    }
    return bytes;
  }

  std::size_t WriteImage(const RawImage& image, std::size_t link) {
    const std::string samples = Samples(image);
    const std::size_t start = bytes_.size();
    bytes_ += samples;
    if (bytes_.size() % 2 != 0) bytes_ += '\0';
    const auto one = [](std::uint16_t tag, double value, std::uint16_t type = 4) {
      return RawTag{.tag = tag, .type = type, .numbers = {value}};
    };
    std::vector<RawTag> tags = image.more;
    const auto add = [&](RawTag tag) {
      const bool there =
          std::ranges::any_of(tags, [&](const RawTag& t) { return t.tag == tag.tag; });
      if (!there) tags.push_back(std::move(tag));
    };
    add(one(256, image.columns));
    add(one(257, image.rows));
    add(one(258, image.bits, 3));
    add(one(259, 1, 3));
    add(one(262, 1, 3));
    add(one(273, static_cast<double>(start)));
    add(one(277, 1, 3));
    add(one(278, image.rows));
    add(one(279, static_cast<double>(samples.size())));
    if (image.format != 0) add(one(339, image.format, 3));
    add({.tag = 33550, .type = 12, .numbers = {30, 30, 0}});
    add({.tag = 33922, .type = 12, .numbers = {0, 0, 0, 500000, 5100000, 0}});
    add({.tag = 34735,
         .type = 3,
         .numbers = {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32610}});
    std::ranges::sort(tags, {}, &RawTag::tag);

    std::string entries;
    for (const RawTag& tag : tags) {
      std::string values = Values(tag);
      const std::size_t count = tag.type == 2 ? values.size() : tag.numbers.size();
      entries += Number(tag.tag, 2) + Number(tag.type, 2) + Number(count, place_bytes());
      if (values.size() <= place_bytes()) {
        values.resize(place_bytes(), '\0');
        entries += values;
      } else {
        entries += Number(bytes_.size(), place_bytes());
        bytes_ += values;
        if (bytes_.size() % 2 != 0) bytes_ += '\0';
      }
    }
    const std::string place = Number(bytes_.size(), place_bytes());
    std::ranges::copy(place, bytes_.begin() + static_cast<std::ptrdiff_t>(link));
    bytes_ += Number(tags.size(), big_tiff_ ? 8 : 2) + entries;
    bytes_ += Number(0, place_bytes());
    return bytes_.size() - place_bytes();
  }

  bool big_endian_;
  bool big_tiff_;
  std::string bytes_;
  mutable int bit_ = 0;
};

}  // namespace

std::string RawTiff(const std::vector<RawImage>& images, bool big_endian, bool big_tiff) {
  return Writer(big_endian, big_tiff).Write(images);
}

}  // namespace farhorizon

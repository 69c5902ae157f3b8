// SPDX-License-Identifier: BSD-3-Clause
// Source: System V ABI, chapters 4 and 5 (ELF header, sections, symbol table, program header).
#include "plugins/elf.hpp"

#include <link.h>

#include <cstring>
#include <vector>

#include "cambium/error.hpp"

namespace cambium {
namespace {

using Header = ElfW(Ehdr);
using Section = ElfW(Shdr);
using Segment = ElfW(Phdr);
using Symbol = ElfW(Sym);

class ElfFile {
 public:
  ElfFile(std::string_view file, const std::string& where) : file_(file), where_(where) {
    if (file.size() < SELFMAG || file.substr(0, SELFMAG) != ELFMAG) fail("is not a shared library");
    header_ = read<Header>(0);
    const int native = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
    if (header_.e_ident[EI_CLASS] != native || header_.e_type != ET_DYN)
      fail("is an ELF file, but not a shared library for this machine");
    if (header_.e_shnum > 0 && header_.e_shentsize != sizeof(Section))
      fail("has a section table that cannot be read");
    check_whole();
  }

  struct Named {
    std::string_view name;
    Symbol symbol;
  };
  /// The symbols that the library defines for others.
  std::vector<Named> exported() const {
    std::vector<Named> out;
    for (std::size_t i = 0; i < header_.e_shnum; ++i) {
      const auto table = section(i);
      if (table.sh_type != SHT_DYNSYM) continue;
      const auto names = bytes(section(table.sh_link).sh_offset, section(table.sh_link).sh_size);
      for (std::size_t at = 0; at + sizeof(Symbol) <= table.sh_size; at += sizeof(Symbol)) {
        const auto symbol = read<Symbol>(table.sh_offset + at);
        const int binding = symbol.st_info >> 4;
        // SHN_ABS: the names of versions, which the linker writes beside the symbols.
        if (symbol.st_shndx != SHN_UNDEF && symbol.st_shndx != SHN_ABS && binding != STB_LOCAL)
          out.push_back({name_at(names, symbol.st_name), symbol});
      }
    }
    return out;
  }

  std::optional<Symbol> find(std::string_view name) const {
    for (const Named& named : exported())
      if (named.name == name) return named.symbol;
    return std::nullopt;
  }

  /// What stands in the file for the addresses that the symbol covers once it is loaded.
  std::string content(const Symbol& symbol) const {
    for (std::size_t i = 0; i < header_.e_phnum; ++i) {
      const auto segment = read<Segment>(header_.e_phoff + i * sizeof(Segment));
      if (segment.p_type != PT_LOAD || symbol.st_value < segment.p_vaddr) continue;
      const auto offset = symbol.st_value - segment.p_vaddr;
      if (offset > segment.p_filesz || symbol.st_size > segment.p_filesz - offset) continue;
      return std::string(bytes(segment.p_offset + offset, symbol.st_size));
    }
    fail("exports a symbol that no segment holds");
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::plugin, where_,
                what +
                    "; expected a plugin built with cambium_add_plugin(): build it again, or "
                    "take it out of the plugin path");
  }

 private:
  // dlopen() maps segments without looking at the length of the file: touching a page behind its
  // end would kill the process.
  void check_whole() const {
    bytes(header_.e_shoff, header_.e_shnum * sizeof(Section));
    for (std::size_t i = 0; i < header_.e_phnum; ++i) {
      const auto segment = read<Segment>(header_.e_phoff + i * sizeof(Segment));
      if (segment.p_type == PT_LOAD) bytes(segment.p_offset, segment.p_filesz);
    }
  }

  std::string_view bytes(std::size_t offset, std::size_t size) const {
    if (offset > file_.size() || size > file_.size() - offset)
      fail("is cut short: it has " + std::to_string(file_.size()) +
           " bytes, and its tables point to "
           "byte " +
           std::to_string(offset));
    return file_.substr(offset, size);
  }

  template <class T>
  T read(std::size_t offset) const {
    T value;
    std::memcpy(&value, bytes(offset, sizeof(T)).data(), sizeof(T));
    return value;
  }

  Section section(std::size_t i) const {
    return read<Section>(header_.e_shoff + i * sizeof(Section));
  }

  static std::string_view name_at(std::string_view names, std::size_t offset) {
    if (offset >= names.size()) return {};
    const auto rest = names.substr(offset);
    return rest.substr(0, rest.find('\0'));
  }

  std::string_view file_;
  const std::string& where_;
  Header header_{};
};

}  // namespace

std::optional<std::string> exported_data(std::string_view file, std::string_view symbol,
                                         const std::string& where) {
  const ElfFile elf(file, where);
  const auto found = elf.find(symbol);
  if (!found) return std::nullopt;
  if ((found->st_info & 0xf) != STT_OBJECT)
    elf.fail("exports '" + std::string(symbol) + "', but not as data");
  return elf.content(*found);
}

std::vector<std::string> exported_symbols(std::string_view file, const std::string& where) {
  std::vector<std::string> out;
  for (const auto& named : ElfFile(file, where).exported()) out.emplace_back(named.name);
  return out;
}

}  // namespace cambium

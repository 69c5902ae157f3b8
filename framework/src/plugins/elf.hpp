// SPDX-License-Identifier: BSD-3-Clause
// Looks into a shared library without opening it, so that nothing of a plugin runs before it is
// known to fit. boost::dll::library_info cannot serve: up to Boost 1.74 it reads .symtab, which a
// stripped library does not have, and it follows sizes found in the file without checking them.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cambium {

/// The bytes, as they stand in the file, of the data symbol that an ELF shared library exports
/// under this name; nothing when there is no such symbol. Pointers in them are not relocated.
/// `where` names the library. Throws Error(plugin) when this is no shared library for this machine,
/// when the file is cut short, or when the symbol is no data.
std::optional<std::string> exported_data(std::string_view file, std::string_view symbol,
                                         const std::string& where);

/// The names of all symbols that the library offers to others, as they stand in its table. Throws
/// as above.
std::vector<std::string> exported_symbols(std::string_view file, const std::string& where);

}  // namespace cambium

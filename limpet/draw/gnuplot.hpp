// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// The bridge to gnuplot: a script and its data in a folder of their own, so that no path of the
/// user's ever stands in a script or on a command line.
namespace limpet::draw::gnuplot {

/// A new folder under the system's folder for temporary files; goes away with its owner.
class TemporaryFolder {
public:
    /// @throws InputError when it cannot be made
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// @return the text as a string of gnuplot's language, whatever it holds; on one line. Quotes,
/// backquotes (commands!), backslashes and their like go as octal numbers.
[[nodiscard]] std::string literal(std::string_view text);

/// Runs a script inside `folder`; file names in it are relative to that.
/// @throws InputError when gnuplot is not installed; InternalError with gnuplot's own words when it
///         does not accept the script
void run(const std::filesystem::path& folder, const std::string& script);

/// Checks before long work whose figures come last.
/// @throws NotInstalled when there is no gnuplot
void must_be_installed();

}  // namespace limpet::draw::gnuplot

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace limpet::loaded {

/// A shared library, there from here on: what is of it may be kept by anyone, so it is never
/// closed.
class Library {
public:
    /// @param file  soname, looked for next to the program and where the system has its libraries,
    ///              or a path
    /// @throws NotInstalled the loader's words
    explicit Library(const std::string& file);

    /// @param found  a function, or data, that becomes what the library has under the name
    /// @throws NotInstalled when it has none
    template <class T>
    void take(T*& found, const char* name) const {
        found = reinterpret_cast<T*>(symbol(name));
    }

private:
    [[nodiscard]] void* symbol(const char* name) const;

    std::string file_;
    void* handle_;
};

}  // namespace limpet::loaded

// SPDX-License-Identifier: Apache-2.0
// What the precompiled headers belong to (packaging/cmake/modules.cmake); nothing runs it.
int main() {}

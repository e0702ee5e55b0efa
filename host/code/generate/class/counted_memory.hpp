// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace tactus::host
{

/// Counts the bytes that the nodes of an exported graph need. While an object exists, every call of operator new on this thread adds to
/// it as it would to a tactus::exported::MemoryBlock: only what was allocated last can be given back. A program that links this class
/// has its own operator new.
class CountedMemory
{
public:
    /// False under sanitizers, which have their own operator new. Then nothing is counted.
    static const bool counts;

    CountedMemory() noexcept;
    ~CountedMemory();
    CountedMemory (const CountedMemory&) = delete;
    CountedMemory& operator= (const CountedMemory&) = delete;

    /// The next allocation is that of a node itself, which is a member of the exported class. It is counted apart.
    void expectNode() noexcept { is_node_next = true; }

    std::size_t bytes() const noexcept { return most; }
    std::size_t nodeBytes() const noexcept { return node_bytes; }

    void take (const void* place, std::size_t size) noexcept;
    void give (const void* place) noexcept;

private:
    struct Block
    {
        const void* place = nullptr;
        std::size_t begin = 0;
    };

    std::array<Block, 256> last {};   // the newest blocks, a ring
    std::size_t count = 0, now = 0, most = 0, node_bytes = 0;
    bool is_node_next = false;
    CountedMemory* const outer;
};

}   // namespace tactus::host

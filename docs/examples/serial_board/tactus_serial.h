/* SPDX-License-Identifier: MIT */
/* The reports of a Tactus board on a serial line, in plain C: docs/devices.md of Tactus describes their bytes. Nothing here waits or allocates. */
#ifndef TACTUS_SERIAL_H
#define TACTUS_SERIAL_H

#include <stdint.h>

enum
{
    tactus_report_size = 64,
    tactus_frame_size = 71 /* 0; the report and its CRC-32 in COBS; 0 */
};

/* What has come of a frame. It begins with all zeros. */
typedef struct
{
    uint8_t bytes[69];
    uint8_t count; /* 70: too many */
} tactus_line;

/* CRC-32 (IEEE). */
static inline uint32_t tactus_crc (const uint8_t* bytes, int count)
{
    uint32_t crc = 0xffffffff;
    for (int i = 0; i < count; ++i)
    {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (0xedb88320 & (0u - (crc & 1u)));
    }
    return ~crc;
}

/* Writes the frame of a report. */
static inline void tactus_frame (const uint8_t report[64], uint8_t frame[71])
{
    const uint32_t crc = tactus_crc (report, 64);
    int code_at = 1, at = 2;
    frame[0] = 0;
    for (int i = 0; i < 68; ++i)
    {
        const uint8_t byte = i < 64 ? report[i] : (uint8_t)(crc >> 8 * (i - 64));
        if (byte != 0)
        {
            frame[at++] = byte;
            continue;
        }
        frame[code_at] = (uint8_t)(at - code_at);
        code_at = at++;
    }
    frame[code_at] = (uint8_t)(at - code_at);
    frame[at] = 0;
}

/* Takes a byte from the line. Returns 1 if it ends a frame without a fault: then the report is in `report`. */
static inline int tactus_take (tactus_line* line, uint8_t byte, uint8_t report[64])
{
    uint8_t summed[68];
    const int is_whole = byte == 0 && line->count == 69;
    int next_zero = line->bytes[0];
    if (byte != 0)
    {
        if (line->count < 69) line->bytes[line->count] = byte;
        if (line->count < 70) ++line->count;
        return 0;
    }
    line->count = 0;
    if (! is_whole) return 0;
    for (int i = 1; i < 69; ++i)
    {
        const int is_zero = i == next_zero;
        summed[i - 1] = is_zero ? 0 : line->bytes[i];
        if (is_zero) next_zero += line->bytes[i];
    }
    const uint32_t crc = tactus_crc (summed, 64);
    for (int i = 0; i < 4; ++i)
        if (summed[64 + i] != (uint8_t)(crc >> 8 * i)) return 0;
    for (int i = 0; i < 64; ++i)
        report[i] = summed[i];
    return next_zero == 69;
}

/* A number of 32 bits in a report, the lowest byte first. */
static inline void tactus_put (uint8_t* report, int at, uint32_t value)
{
    for (int i = 0; i < 4; ++i)
        report[at + i] = (uint8_t)(value >> 8 * i);
}

static inline uint32_t tactus_get (const uint8_t* report, int at)
{
    uint32_t value = 0;
    for (int i = 0; i < 4; ++i)
        value |= (uint32_t)report[at + i] << 8 * i;
    return value;
}

/* 1 if a report is one from Tactus: its first bytes and its own CRC are right. */
static inline int tactus_asks (const uint8_t report[64])
{
    return report[0] == 0x54 && report[1] == 1 && tactus_get (report, 60) == tactus_crc (report, 60);
}

#endif

/* seen.h - step 1 of the command: has an id been there before? */
#ifndef SURFMINK_COMMAND_SEEN_H
#define SURFMINK_COMMAND_SEEN_H

#include "common.h"

enum { MOST_SEEN = 1 << 20 }; /* ids that are remembered, so that memory does not grow with the table */

/* Hashes of ids, in a table with open addressing; 0 is an empty place. */
typedef struct seen_ids {
    uint64_t *hash;
    size_t count, room;
} seen_ids;

static uint64_t hash_id(const char *id)
{
    uint64_t hash = 0xcbf29ce4;
    for (; *id; ++id) hash = ((hash ^ (unsigned char)*id) & 0xffffffffffff) * 0x5bd1 ^ hash >> 40;
    return hash | 1;
}

/* Where the hash is, or belongs. */
static size_t place_of_hash(const seen_ids *s, uint64_t hash)
{
    size_t at = (size_t)(hash >> 1) & (s->room - 1);
    while (s->hash[at] && s->hash[at] != hash) at = (at + 1) & (s->room - 1);
    return at;
}

/* Twice the room, and all hashes at their places in it. */
static void make_room_for_ids(seen_ids *s)
{
    uint64_t *old = s->hash;
    size_t old_room = s->room, i;
    s->room = old_room ? 2 * old_room : 256;
    s->hash = (uint64_t *)resize(NULL, s->room, sizeof *s->hash);
    memset(s->hash, 0, s->room * sizeof *s->hash);
    for (i = 0; i < old_room; ++i)
        if (old[i]) s->hash[place_of_hash(s, old[i])] = old[i];
    free(old);
}

/* Has this id been asked for before? */
static int is_seen(seen_ids *s, const char *id)
{
    uint64_t hash = hash_id(id);
    size_t at;
    if (2 * s->count >= s->room && s->count < MOST_SEEN) make_room_for_ids(s);
    at = place_of_hash(s, hash);
    if (s->hash[at] == hash) return 1;
    if (s->count == MOST_SEEN) return 0;
    s->hash[at] = hash;
    ++s->count;
    return 0;
}

static void free_seen(seen_ids *s)
{
    free(s->hash);
}

#endif

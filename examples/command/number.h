/* number.h - numbers out of text and into text: correctly rounded, fast, the same in every locale. Copy it: it needs no
   other file and has no globals.

     powers_of_ten powers;                           16 KB, yours
     prepare_powers(&powers);                        once, about 150 microseconds
     end = read_number(&powers, text, &value);       behind the number; NULL if the text does not begin with one
     end = write_number(&powers, text, 17, value);   behind the text, 24 characters or less, without a zero byte

   READING takes what strtod takes in the locale "C": blanks, a sign, digits with or without a point and an exponent,
   hexadecimal digits after 0x, inf, infinity, nan, nan(word). The value is the double nearest to what is written, of
   two as near the even one; too much is infinite and too little is zero, without a word, and errno is left alone.
   WRITING is printf's %.17g, with 1 to 17 digits.

   METHOD
     1 The first 19 significant digits are an integer w < 2^64, so that the value is w 10^q.
     2 w times the first 64 of 128 known bits of 10^q. The product is too small by less than 3 in its 64th bit; unless
       the middle between two doubles lies there, it decides where to round. That is the end for 998 numbers in 1000.
     3 w times all 128 bits. From 10^0 to 10^55 these are all there are, and the product is exact; otherwise it decides
       unless 63 bits in a row happen to be 1, as they are if the value is just such a middle.
     4 If there are more than 19 digits, w and w + 1 must lead to the same double.
     5 What is still open, and what is less than the least double: long division of big integers, from all digits.
     Writing is the same the other way round: the bits of the double times 10^q, rounded to an integer of 17 digits.
   COST where strtod takes 80 ns for 17 digits and printf 180: reading 25 ns, writing 45; reading more digits 55. Step 5
   takes from 1 to 50 microseconds. With NULL for the powers it is the only one: for a few numbers.
   THANKS to those who found the method
     W. D. Clinger: How to read floating point numbers accurately, PLDI 1990
     D. Lemire: Number parsing at a gigabyte per second, Software: Practice and Experience 51 (2021), after M. Eisel
     F. Loitsch: Printing floating-point numbers quickly and accurately with integers, PLDI 2010

   Assumes what all machines of today have: doubles of 64 bits as in IEEE 754, integers in the same order of bytes. */
#ifndef SURFMINK_COMMAND_NUMBER_H
#define SURFMINK_COMMAND_NUMBER_H

#include <stdint.h>
#include <string.h>

/* --- big integers ------------------------------------------------------------------------------------------------- */

/* Room for 3072 bits. What is needed most is one bit more than 10^801 < 2^2661 or 5^1131 < 2^2627. */
enum { BIG_WORDS = 96 };

typedef struct big {
    int words;                /* the last of which is not 0; 0 words are the number 0 */
    uint32_t word[BIG_WORDS]; /* least significant first */
} big;

static void big_multiply_add(big *x, uint32_t factor, uint32_t summand)
{
    uint64_t carry = summand;
    int i;
    for (i = 0; i < x->words; ++i) {
        carry += (uint64_t)x->word[i] * factor;
        x->word[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry) x->word[x->words++] = (uint32_t)carry;
}

/* Rounds down; so does a row of divisions, which is why 5 may be divided off again and again. */
static void big_divide(big *x, uint32_t divisor)
{
    uint64_t rest = 0;
    int i;
    for (i = x->words; i-- > 0;) {
        rest = rest << 32 | x->word[i];
        x->word[i] = (uint32_t)(rest / divisor);
        rest %= divisor;
    }
    while (x->words > 0 && x->word[x->words - 1] == 0) --x->words;
}

static void big_multiply_by_5(big *x, int64_t times)
{
    for (; times >= 13; times -= 13) big_multiply_add(x, 1220703125, 0);
    for (; times > 0; --times) big_multiply_add(x, 5, 0);
}

static void big_double(big *x, int times)
{
    for (; times >= 31; times -= 31) big_multiply_add(x, 0x80000000u, 0);
    big_multiply_add(x, (uint32_t)1 << times, 0);
}

/* x = 2^exponent. */
static void big_set(big *x, int exponent)
{
    x->words = 1;
    x->word[0] = 1;
    big_double(x, exponent);
}

static int big_bits(const big *x)
{
    uint32_t top = x->words > 0 ? x->word[x->words - 1] : 0;
    int bits = 32 * x->words;
    for (; x->words > 0 && !(top >> 31); top <<= 1) --bits;
    return bits;
}

static int big_is_less(const big *x, const big *y)
{
    int i = x->words;
    if (x->words != y->words) return x->words < y->words;
    while (i > 0 && x->word[i - 1] == y->word[i - 1]) --i;
    return i > 0 && x->word[i - 1] < y->word[i - 1];
}

/* x >= y. */
static void big_subtract(big *x, const big *y)
{
    uint64_t borrow = 0, rest;
    int i;
    for (i = 0; i < x->words; ++i) {
        rest = ((uint64_t)1 << 32) + x->word[i] - (i < y->words ? y->word[i] : 0) - borrow;
        x->word[i] = (uint32_t)rest;
        borrow = !(rest >> 32);
    }
    while (x->words > 0 && x->word[x->words - 1] == 0) --x->words;
}

/* --- powers of ten ------------------------------------------------------------------------------------------------ */

/* Outside of these, 19 digits times 10^q are infinite or 0. */
enum { LEAST_POWER = -342, GREATEST_POWER = 308 };

/* 10^q = (2^64 high + low + rest) 2^exponent: the top bit of high is set, 0 <= rest < 1. */
typedef struct power_of_ten {
    uint64_t high, low;
    int exponent;
    int exact; /* rest is 0: for q from 0 to 55 */
} power_of_ten;

typedef struct powers_of_ten {
    power_of_ten of[GREATEST_POWER - LEAST_POWER + 1];
} powers_of_ten;

static uint64_t big_32_bits(const big *x, int from)
{
    int word = from / 32;
    uint64_t next = word + 1 < x->words ? x->word[word + 1] : 0;
    return (next << 32 | x->word[word]) >> (from % 32) & UINT32_MAX;
}

/* The leading 128 bits of x 2^exponent; x has as many. */
static void keep_power(power_of_ten *power, const big *x, int exponent)
{
    int end = big_bits(x);
    power->high = big_32_bits(x, end - 32) << 32 | big_32_bits(x, end - 64);
    power->low = big_32_bits(x, end - 96) << 32 | big_32_bits(x, end - 128);
    power->exponent = exponent + end - 128;
    power->exact = exponent >= -128 && exponent <= 55 - 128; /* 5^55 < 2^128 < 5^56 */
}

/* 10^q = 5^q 2^q. Fives are multiplied to 2^128, or divided off 2^960, of which 165 bits are left in the end. */
static inline void prepare_powers(powers_of_ten *powers)
{
    big x;
    int q;
    big_set(&x, 128);
    for (q = 0; q <= GREATEST_POWER; ++q) {
        keep_power(&powers->of[q - LEAST_POWER], &x, q - 128);
        big_multiply_add(&x, 5, 0);
    }
    big_set(&x, 960);
    for (q = -1; q >= LEAST_POWER; --q) {
        big_divide(&x, 5);
        keep_power(&powers->of[q - LEAST_POWER], &x, q - 960);
    }
}

/* --- products ----------------------------------------------------------------------------------------------------- */

/* A number (m + rest) 2^exponent. The top bit of m is set, 0 <= rest < 1, and `more` says that rest is not 0. */
typedef struct product {
    uint64_t m;
    int64_t exponent;
    int more;
} product;

static int leading_zeros(uint64_t x)
{
#if defined(__GNUC__)
    return __builtin_clzll(x);
#else
    int zeros = 0;
    for (; !(x >> 56); x <<= 8) zeros += 8;
    for (; !(x >> 63); x <<= 1) ++zeros;
    return zeros;
#endif
}

/* The upper half of a b. */
static uint64_t multiply(uint64_t a, uint64_t b, uint64_t *lower)
{
    uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
    uint64_t first = a0 * b0, second = a1 * b0 + (first >> 32), third = a0 * b1 + (uint32_t)second;
    *lower = third << 32 | (uint32_t)first;
    return a1 * b1 + (second >> 32) + (third >> 32);
}

/* 2^64 high + low, the leading digits of a product, which is at least half as large as it could be. */
static product begin_with(uint64_t high, uint64_t low, int64_t exponent)
{
    int shift = !(high >> 63);
    product x;
    x.m = shift ? high << 1 | low >> 63 : high;
    x.exponent = exponent - shift;
    x.more = 1;
    return x;
}

/* w 10^q from half of the bits of 10^q, where the top bit of w is set: m is right, or too small by 1 or 2. */
static product quick_product(const power_of_ten *power, uint64_t w)
{
    uint64_t middle, high = multiply(w, power->high, &middle);
    return begin_with(high, middle, 128 + power->exponent);
}

/* From all of them: m is right, or rounded as if it were. Returns 0 if that would take even more bits to tell. */
static int whole_product(const power_of_ten *power, uint64_t w, product *x)
{
    uint64_t low, middle, high = multiply(w, power->high, &middle), carry = multiply(w, power->low, &low);
    middle += carry;
    high += middle < carry;
    *x = begin_with(high, middle, 128 + power->exponent);
    x->more = !power->exact || (high >> 63 ? middle : middle << 1) != 0 || low != 0;
    return power->exact || middle != UINT64_MAX; /* else what the power lacks may carry into m, to the middle */
}

/* Without the last bits of m, may x be rounded one way if m is right and another way if m is too small by 1 or 2? */
static int is_near_middle(const product *x, int64_t lost)
{
    uint64_t half = (uint64_t)1 << (lost - 1), rest = x->m & (2 * half - 1);
    return rest <= half && half - rest <= 2;
}

/* m without its last bits, from 1 to 64, rounded to nearest, and where that is not one number, to even. */
static uint64_t round_off(const product *x, int64_t lost)
{
    uint64_t kept = lost < 64 ? x->m >> lost : 0, half = (uint64_t)1 << (lost - 1), rest = x->m & (2 * half - 1);
    return kept + (rest > half || (rest == half && (x->more || (kept & 1))));
}

/* x / y, by long division. */
static product divide(big *x, big *y)
{
    int shift = big_bits(x) - big_bits(y), i;
    product ratio;
    if (shift > 0) big_double(y, shift);
    if (shift < 0) big_double(x, -shift);
    if (big_is_less(x, y)) {
        big_double(x, 1);
        --shift;
    }
    ratio.m = 0;
    for (i = 0; i < 64; ++i) {
        ratio.m <<= 1;
        if (!big_is_less(x, y)) {
            big_subtract(x, y);
            ++ratio.m;
        }
        big_double(x, 1);
    }
    ratio.exponent = shift - 63;
    ratio.more = x->words > 0;
    return ratio;
}

/* x 10^q. */
static product exact_product(big *x, int64_t q)
{
    product ratio;
    big y;
    big_set(&y, 0);
    big_multiply_by_5(q < 0 ? &y : x, q < 0 ? -q : q);
    ratio = divide(x, &y);
    ratio.exponent += q;
    return ratio;
}

/* --- bits of a double --------------------------------------------------------------------------------------------- */

static const uint64_t infinite_bits = (uint64_t)0x7ff << 52, nan_bits = (uint64_t)0x7ff8 << 48;

/* How many bits of m a double has no room for: 64 - 53, and more if it is subnormal. */
static int64_t bits_to_lose(const product *x)
{
    return x->exponent >= -1085 ? 11 : -1074 - x->exponent;
}

/* A carry out of the 53 bits counts the exponent up, as it should, to infinity if need be. */
static uint64_t nearest_double(const product *x)
{
    int64_t lost = bits_to_lose(x);
    if (x->exponent > 960) return infinite_bits;
    if (lost > 64) return 0;
    return round_off(x, lost) + (x->exponent > -1085 ? (uint64_t)(x->exponent + 1085) << 52 : 0);
}

/* --- step 1: digits ----------------------------------------------------------------------------------------------- */

/* The value is w 10^exponent; if digits are left over, more than that and less than (w + 1) 10^exponent. */
typedef struct decimal {
    const char *begin, *end; /* digits and at most one point */
    int64_t written;         /* the exponent behind them */
    uint64_t w;
    int64_t exponent;
    int left_over; /* digits, not all 0 */
} decimal;

static unsigned digit_of(char c)
{
    return (unsigned)((unsigned char)c - '0');
}

/* The number behind an e or p, added to the exponent; without a number s is where it stops. No text is so long that its
   digits could make up for an exponent of 10^17. */
static const char *read_exponent(const char *s, int64_t *exponent)
{
    const char *at = s + 1;
    int64_t number = 0;
    int negative = *at == '-';
    if (*at == '-' || *at == '+') ++at;
    if (digit_of(*at) > 9) return s;
    for (; digit_of(*at) <= 9; ++at)
        if (number < 100000000000000000) number = 10 * number + (int64_t)digit_of(*at);
    *exponent += negative ? -number : number;
    return at;
}

/* More digits than 64 bits can hold, unless they begin with zeros. */
static void keep_19_digits(decimal *d)
{
    const char *s;
    int kept = 0, point = 0;
    d->w = 0;
    d->exponent = 0;
    for (s = d->begin; s < d->end; ++s) {
        if (*s == '.')
            point = 1;
        else if (kept < 19) {
            d->w = 10 * d->w + digit_of(*s);
            d->exponent -= point;
            kept += d->w > 0;
        } else {
            d->left_over |= *s != '0';
            d->exponent += !point;
        }
    }
}

static const char *read_digits(decimal *d, const char *s)
{
    const char *behind_point = NULL;
    uint64_t w = 0;
    d->begin = s;
    for (; digit_of(*s) <= 9; ++s) w = 10 * w + digit_of(*s);
    if (*s == '.') {
        behind_point = ++s;
        for (; digit_of(*s) <= 9; ++s) w = 10 * w + digit_of(*s);
    }
    d->end = s;
    d->w = w;
    d->exponent = behind_point ? behind_point - s : 0;
    d->written = d->left_over = 0;
    if (s - d->begin == (behind_point != NULL)) return NULL;
    if (s - d->begin - (behind_point != NULL) > 19) keep_19_digits(d);
    if (*s == 'e' || *s == 'E') s = read_exponent(s, &d->written);
    d->exponent += d->written;
    return s;
}

/* --- step 5: all digits ------------------------------------------------------------------------------------------- */

/* The middle between two doubles has at most 768 digits: whatever else follows 800 of them only says on which side. */
enum { MOST_DIGITS = 800 };

/* The digits as an integer; returns how many these are. What is left over becomes a last digit 1. */
static int big_from_digits(big *x, const decimal *d, int64_t *exponent)
{
    const char *s;
    int kept = 0, point = 0, left_over = 0;
    x->words = 0;
    *exponent = d->written;
    for (s = d->begin; s < d->end; ++s) {
        if (*s == '.')
            point = 1;
        else if (kept < MOST_DIGITS) {
            big_multiply_add(x, 10, digit_of(*s));
            *exponent -= point;
            kept += x->words > 0;
        } else {
            left_over |= *s != '0';
            *exponent += !point;
        }
    }
    if (!left_over) return kept;
    big_multiply_add(x, 10, 1);
    --*exponent;
    return kept + 1;
}

static uint64_t exact_double(const decimal *d)
{
    big x;
    product whole;
    int64_t q;
    int digits = big_from_digits(&x, d, &q);
    if (x.words == 0 || q + digits < -330) return 0;
    if (q + digits > 310) return infinite_bits;
    whole = exact_product(&x, q);
    return nearest_double(&whole);
}

/* --- text to double ----------------------------------------------------------------------------------------------- */

/* The double nearest to w 10^q, where w > 0; returns 0 if it cannot be told. */
static int quick_double(const powers_of_ten *powers, uint64_t w, int64_t q, uint64_t *bits)
{
    const power_of_ten *power;
    int zeros = leading_zeros(w), told = 1;
    product x;
    *bits = q > 0 ? infinite_bits : 0;
    if (q < LEAST_POWER || q > GREATEST_POWER) return 1;
    power = &powers->of[q - LEAST_POWER];
    x = quick_product(power, w << zeros);
    x.exponent -= zeros;
    if (bits_to_lose(&x) > 63) return 0;
    if (is_near_middle(&x, bits_to_lose(&x))) {
        told = whole_product(power, w << zeros, &x);
        x.exponent -= zeros;
    }
    *bits = nearest_double(&x);
    return told;
}

static const char *read_decimal(const powers_of_ten *powers, const char *s, uint64_t *bits)
{
    decimal d;
    uint64_t above;
    s = read_digits(&d, s);
    *bits = 0;
    if (!s || d.w == 0) return s;
    if (powers && quick_double(powers, d.w, d.exponent, bits)) {
        if (!d.left_over) return s;
        if (quick_double(powers, d.w + 1, d.exponent, &above) && above == *bits) return s;
    }
    *bits = exact_double(&d);
    return s;
}

static int hexadecimal_digit(char c)
{
    if (digit_of(c) <= 9) return (int)digit_of(c);
    c |= 0x20;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* What follows 0x. */
static const char *read_hexadecimal(const char *s, uint64_t *bits)
{
    product x = {0, 0, 0};
    int digit, digits = 0, point = 0;
    for (;; ++s) {
        digit = hexadecimal_digit(*s);
        if (*s == '.' && !point) {
            point = 1;
            continue;
        }
        if (digit < 0) break;
        digits = 1;
        if (x.m >> 60) {
            x.more |= digit;
            x.exponent += point ? 0 : 4;
        } else {
            x.m = x.m << 4 | (uint64_t)digit;
            x.exponent -= point ? 4 : 0;
        }
    }
    if (!digits) return NULL;
    if (*s == 'p' || *s == 'P') s = read_exponent(s, &x.exponent);
    *bits = 0;
    if (x.m == 0) return s;
    x.exponent -= leading_zeros(x.m);
    x.m <<= leading_zeros(x.m);
    *bits = nearest_double(&x);
    return s;
}

/* Behind the word, in small or capital letters; NULL if the text does not begin with it. */
static const char *skip_word(const char *s, const char *word)
{
    for (; *word; ++s, ++word)
        if ((*s | 0x20) != *word) return NULL;
    return s;
}

static const char *read_word(const char *s, uint64_t *bits)
{
    const char *end = skip_word(s, "inf"), *more;
    *bits = infinite_bits;
    if (end) return (more = skip_word(end, "inity")) ? more : end;
    *bits = nan_bits;
    if (!(end = skip_word(s, "nan")) || *end != '(') return end;
    for (more = end + 1; digit_of(*more) <= 9 || *more == '_' || ((*more | 0x20) >= 'a' && (*more | 0x20) <= 'z');)
        ++more;
    return *more == ')' ? more + 1 : end;
}

/* See the top of this file. */
static inline const char *read_number(const powers_of_ten *powers, const char *text, double *value)
{
    const char *s = text, *end = NULL;
    uint64_t bits = 0;
    int negative;
    while (*s == ' ' || (*s >= '\t' && *s <= '\r')) ++s;
    negative = *s == '-';
    if (*s == '-' || *s == '+') ++s;
    if (s[0] == '0' && (s[1] | 0x20) == 'x') end = read_hexadecimal(s + 2, &bits);
    if (!end) end = read_decimal(powers, s, &bits);
    if (!end) end = read_word(s, &bits);
    if (!end) return NULL;
    bits |= (uint64_t)negative << 63;
    memcpy(value, &bits, sizeof *value);
    return end;
}

/* The whole text as a number. */
static inline int parse_number(const powers_of_ten *powers, const char *text, double *value)
{
    const char *end = read_number(powers, text, value);
    return end && *end == '\0';
}

/* --- double to text ----------------------------------------------------------------------------------------------- */

/* A number below 10^18 as so many digits. Two halves, for the processor to do side by side. */
static void put_digits(char *text, uint64_t number, int digits)
{
    uint32_t lower = (uint32_t)(number % 1000000000), upper = (uint32_t)(number / 1000000000);
    int i = digits;
    for (; i > 0 && i > digits - 9; lower /= 10) text[--i] = (char)('0' + lower % 10);
    for (; i > 0; upper /= 10) text[--i] = (char)('0' + upper % 10);
}

/* w 2^exponent 10^q, where the top bit of w is set, rounded to an integer; the value lies between 1 and 10^18. */
static uint64_t round_to_integer(const powers_of_ten *powers, uint64_t w, int exponent, int q)
{
    product x = {0, 0, 0};
    big all;
    int told = powers && q <= GREATEST_POWER;
    if (told) x = quick_product(&powers->of[q - LEAST_POWER], w);
    if (told && is_near_middle(&x, -x.exponent - exponent)) told = whole_product(&powers->of[q - LEAST_POWER], w, &x);
    if (!told) {
        all.words = 2;
        all.word[0] = (uint32_t)w;
        all.word[1] = (uint32_t)(w >> 32);
        x = exact_product(&all, q);
    }
    return round_off(&x, -x.exponent - exponent);
}

/* The first digits of w 2^exponent, where the top bit of w is set, as an integer. *place: of the first of them; the one
   before the point is 0. */
static uint64_t first_digits(const powers_of_ten *powers, uint64_t w, int exponent, int digits, int *place)
{
    static const uint32_t ten_to[10] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000};
    uint64_t limit = digits < 9 ? ten_to[digits] : (uint64_t)ten_to[9] * ten_to[digits - 9], number;
    /* log10(2) = 78913 / 2^18 + 3e-8, so this is the place for 2^(exponent + 63), and may be one too low for w. */
    *place = ((exponent + 63) * 78913 + (400 << 18)) / (1 << 18) - 400;
    number = round_to_integer(powers, w, exponent, digits - 1 - *place);
    if (number < limit) return number;
    ++*place;
    if (number == limit) return number / 10;
    return round_to_integer(powers, w, exponent, digits - 1 - *place);
}

static char *put(char *to, const char *from, int count)
{
    memcpy(to, from, (size_t)count);
    return to + count;
}

static char *put_with_point(char *to, const char *digit, int n, int place)
{
    if (place >= 0) {
        to = put(to, digit, place + 1);
        if (n <= place + 1) return to;
        *to++ = '.';
        return put(to, digit + place + 1, n - place - 1);
    }
    to = put(to, "0.0000", 1 - place);
    return put(to, digit, n);
}

static char *put_with_exponent(char *to, const char *digit, int n, int place)
{
    *to++ = *digit;
    if (n > 1) *to++ = '.';
    to = put(to, digit + 1, n - 1);
    *to++ = 'e';
    *to++ = place < 0 ? '-' : '+';
    if (place < 0) place = -place;
    if (place >= 100) *to++ = (char)('0' + place / 100);
    *to++ = (char)('0' + place / 10 % 10);
    *to++ = (char)('0' + place % 10);
    return to;
}

/* See the top of this file. */
static inline char *write_number(const powers_of_ten *powers, char *text, int digits, double value)
{
    char digit[17];
    uint64_t bits, w;
    int exponent, place, n = digits;
    memcpy(&bits, &value, sizeof bits);
    if (bits >> 63) *text++ = '-';
    exponent = (int)(bits >> 52 & 0x7ff);
    w = bits & (((uint64_t)1 << 52) - 1);
    if (exponent == 0x7ff) return put(text, w ? "nan" : "inf", 3);
    if (exponent > 0) w |= (uint64_t)1 << 52;
    if (w == 0) return put(text, "0", 1);
    exponent += (exponent == 0) - 1075 - leading_zeros(w);
    w <<= leading_zeros(w);
    put_digits(digit, first_digits(powers, w, exponent, digits, &place), digits);
    while (n > 1 && digit[n - 1] == '0') --n;
    return place < -4 || place >= digits ? put_with_exponent(text, digit, n, place)
                                         : put_with_point(text, digit, n, place);
}

#endif

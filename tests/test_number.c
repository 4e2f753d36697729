/* Numbers out of text and into text, bit for bit and byte for byte as the C library does it. That must round correctly
   itself, as glibc, musl, the BSDs and Apple's do.
   cc -I. tests/test_number.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "examples/command/number.h"
#include "harness.h"
#include "shapes.h"

#include <locale.h>
#include <stdlib.h>

enum { LONGEST = 4000 };

static powers_of_ten powers;

/* --- what is compared --------------------------------------------------------------------------------------------- */

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Any finite double; many subnormal ones. */
static double any_double(chance *c)
{
    double x;
    do x = double_of(chance_bits(c) >> (one_of(c, 8) == 0 ? one_of(c, 64) : 0));
    while (!isfinite(x));
    return x;
}

/* The same number, and the same end of it. */
static void is_read_as_by_strtod(const powers_of_ten *with, const char *text)
{
    char *end;
    double want = strtod(text, &end), got = -1;
    const char *stop = read_number(with, text, &got);
    COUNTED;
    if (end == text) got = want = 0;
    if (stop == (end == text ? NULL : end) && (bits_of(got) == bits_of(want) || (isnan(got) && isnan(want)))) return;
    CASE("%.150s%s", text, with ? "" : ", the long way");
    CHECK(stop == (end == text ? NULL : end));
    CHECK_SAME(&got, &want, 1);
}

static void is_written_as_by_printf(const powers_of_ten *with, int digits, double x)
{
    char want[64], got[64];
    snprintf(want, sizeof want, "%.*g", digits, x);
    memset(got, '?', sizeof got);
    *write_number(with, got, digits, x) = '\0';
    COUNTED;
    if (strlen(got) < sizeof got && strcmp(got, want) == 0) return;
    CASE("%.*g is written as %s%s", digits, x, got, with ? "" : ", the long way");
    CHECK(strcmp(got, want) == 0);
}

/* --- reading ------------------------------------------------------------------------------------------------------ */

THEOREM(every_notation_that_strtod_reads_is_read_and_no_other)
{
    static const char *const text[] = {"",
                                       " ",
                                       "-",
                                       "+",
                                       ".",
                                       "-.",
                                       "e",
                                       "e5",
                                       ".e5",
                                       "x",
                                       "-x",
                                       "--1",
                                       "+-1",
                                       "1-",
                                       "0",
                                       "-0",
                                       "+0",
                                       "00",
                                       "0.0",
                                       "-0.",
                                       ".0",
                                       "0e",
                                       "0e5",
                                       "0e999999999999999999999",
                                       "1",
                                       "+1",
                                       "-1",
                                       " 1",
                                       "\t\n\v\f\r-1",
                                       "1 ",
                                       "1\n",
                                       "- 1",
                                       "1e",
                                       "1e+",
                                       "1e-",
                                       "1e+x",
                                       "1ex",
                                       "1e5",
                                       "1E5",
                                       "1e+5",
                                       "1e-5",
                                       "1e05",
                                       "1e 5",
                                       "1d5",
                                       "1e5.5",
                                       "5.",
                                       "5.e1",
                                       ".5",
                                       "-.5",
                                       "5..",
                                       "5.5.5",
                                       "1,5",
                                       "1_000",
                                       "007",
                                       "0.1",
                                       "1e22",
                                       "1e23",
                                       "123456789012345678901234567890",
                                       "0.000000000000000000001",
                                       "1e308",
                                       "1e309",
                                       "1e400",
                                       "-1e400",
                                       "1e99999999999999999999",
                                       "1e-400",
                                       "-1e-400",
                                       "1e-99999999999999999999",
                                       "1.7976931348623157e308",
                                       "1.7976931348623158e308",
                                       "1.797693134862315807e308",
                                       "1.797693134862315808e308",
                                       "17976931348623159e292",
                                       "2.2250738585072014e-308",
                                       "2.2250738585072011e-308",
                                       "2.2250738585072012e-308",
                                       "4.9e-324",
                                       "5e-324",
                                       "3e-324",
                                       "2e-324",
                                       "2.4703282292062327e-324",
                                       "2.4703282292062328e-324",
                                       "7.4e-324",
                                       "9007199254740993",
                                       "9007199254740993.0",
                                       "9007199254740993.00000000000000000000000000000000000000001",
                                       "9007199254740992.99999999999999999999999999",
                                       "0.500000000000000166533453693773481063544750213623046875",
                                       "9223372036854775807",
                                       "9223372036854775808",
                                       "18446744073709551615",
                                       "18446744073709551616",
                                       "9999999999999999999",
                                       "10000000000000000000",
                                       "1e0000000000000000000000000000000001",
                                       "3.518437208883201171875e13",
                                       "8.5e-43",
                                       "0x",
                                       "0x1",
                                       "0X1",
                                       "0x1p3",
                                       "0x1P-3",
                                       "-0x1.8p1",
                                       "0x.8",
                                       "0x8.",
                                       "0x.",
                                       "0x.p1",
                                       "0xp1",
                                       "0x1p",
                                       "0x1p+",
                                       "0x1px",
                                       "0x1.fffffffffffffp1023",
                                       "0x1.fffffffffffff8p1023",
                                       "0x1.fffffffffffff7fp1023",
                                       "0x1p1024",
                                       "0x1p-1074",
                                       "0x1p-1075",
                                       "0x1.8p-1075",
                                       "0x1.00000000000000000001p-1075",
                                       "0x1p-1076",
                                       "0x3p-1076",
                                       "0x1.00000000000008p0",
                                       "0x1.000000000000080000000000000001p0",
                                       "0x1.00000000000018p0",
                                       "0x123456789abcdef0123456789abcdef",
                                       "0xg",
                                       "0x0",
                                       "0x0.00000000000000000000000000000000001p140",
                                       "0x1p99999999999999999999",
                                       "0x1p-99999999999999999999",
                                       "1x0",
                                       "0x0p99999999999999999999",
                                       "0x1..8",
                                       "0xAbCdEf.fEdCbA",
                                       "inf",
                                       "-inf",
                                       "+INF",
                                       "Infinity",
                                       "-iNFiNiTy",
                                       "infinit",
                                       "in",
                                       "i",
                                       "nan",
                                       "NaN",
                                       "-nan",
                                       "nan(",
                                       "nan()",
                                       "nan(1)",
                                       "nan(a_Z9)",
                                       "nan(a b)",
                                       "nan(-1)",
                                       "na",
                                       "n",
                                       "nano",
                                       "infinity5",
                                       " inf",
                                       "- inf",
                                       "1inf",
                                       "\xc3\xa9",
                                       "\xb1",
                                       "1\xb2"};
    size_t i;
    for (i = 0; i < sizeof text / sizeof *text; ++i) {
        is_read_as_by_strtod(&powers, text[i]);
        is_read_as_by_strtod(NULL, text[i]);
    }
}

THEOREM(a_whole_text_is_a_number_or_it_is_none)
{
    double x = 0;
    CHECK(parse_number(&powers, "-2.5", &x) && x == -2.5);
    CHECK(parse_number(&powers, " 0x1p3", &x) && x == 8);
    CHECK(!parse_number(&powers, "", &x));
    CHECK(!parse_number(&powers, "1 ", &x));
    CHECK(!parse_number(&powers, "1e", &x));
    CHECK(!parse_number(&powers, "1,5", &x));
    CHECK(!parse_number(&powers, "x", &x));
}

/* 1 to 25 digits, perhaps a point before or among them, and an exponent, from all of the range or from a small part. */
static void random_number(chance *c, char *text)
{
    int digits = 1 + (int)one_of(c, 25), point = (int)one_of(c, 28), range = one_of(c, 2) ? 700 : 40, i;
    if (one_of(c, 4) == 0) *text++ = '-';
    for (i = 0; i < digits; ++i) {
        if (i == point) *text++ = '.';
        *text++ = one_of(c, 6) ? (char)('0' + one_of(c, 10)) : '0';
    }
    *text = '\0';
    if (one_of(c, 8)) sprintf(text, "e%d", (int)one_of(c, (size_t)range) - range / 2);
}

THEOREM(digits_lead_to_the_nearest_double)
{
    chance c = {seed(2021)};
    char text[64];
    int trial;
    for (trial = 0; trial < 100000; ++trial) {
        random_number(&c, text);
        is_read_as_by_strtod(&powers, text);
        if (trial % 50 == 0) is_read_as_by_strtod(NULL, text);
    }
}

THEOREM(what_printf_printed_with_17_digits_comes_back)
{
    chance c = {seed(17)};
    char text[64];
    double x, again;
    int trial;
    for (trial = 0; trial < 60000; ++trial) {
        x = any_double(&c);
        sprintf(text, "%.17g", x);
        if (!read_number(&powers, text, &again) || bits_of(x) != bits_of(again)) {
            CASE("%s", text);
            CHECK_SAME(&again, &x, 1);
        }
        sprintf(text, "%.*g", 1 + (int)one_of(&c, 24), x);
        is_read_as_by_strtod(&powers, text);
        sprintf(text, "%.*a", (int)one_of(&c, 16), x);
        is_read_as_by_strtod(&powers, text);
    }
}

/* All digits of the middle between two neighbours, positive and finite, with what is put before the exponent. */
static void put_middle(char *text, double below, const char *more)
{
    uint64_t bits = bits_of(below), m = bits & (((uint64_t)1 << 52) - 1);
    int biased = (int)(bits >> 52), two, ten, i;
    char digit[LONGEST];
    big x;
    if (biased > 0) m |= (uint64_t)1 << 52;
    two = (biased > 0 ? biased : 1) - 1076; /* below is 2 m 2^two, and the middle one m more: 2 m + 1 */
    ten = two < 0 ? two : 0;
    m = 2 * m + 1;
    x.words = 1;
    x.word[0] = (uint32_t)m;
    if (m >> 32) x.word[x.words++] = (uint32_t)(m >> 32);
    if (two < 0)
        big_multiply_by_5(&x, -two);
    else
        big_double(&x, two);
    for (i = LONGEST; x.words > 0;) {
        big quotient = x;
        big_divide(&quotient, 10);
        big_multiply_add(&quotient, 10, 0);
        digit[--i] = (char)('0' + (int)(x.word[0] - (quotient.words > 0 ? quotient.word[0] : 0)));
        big_divide(&x, 10);
    }
    sprintf(text, "%.*s%se%d", LONGEST - i, digit + i, more, *more ? ten - (int)strlen(more) : ten);
}

static void text_leads_to(const char *text, double want)
{
    double got = -1;
    is_read_as_by_strtod(&powers, text);
    read_number(&powers, text, &got);
    CASE("%.150s", text);
    CHECK_SAME(&got, &want, 1);
}

THEOREM(halfway_text_rounds_to_even_and_else_to_the_nearer_double)
{
    static char text[LONGEST + 100];
    char many[1000];
    chance c = {seed(1990)};
    int trial;
    memset(many, '0', sizeof many);
    memcpy(many + 900, "1", 2);
    for (trial = 0; trial < 300; ++trial) {
        double below = fabs(any_double(&c)), above;
        char *last;
        if (trial % 3 == 0) below = floor(between(&c, 1e15, 8e15)) * power_of_two(trial / 3 % 12 - 9); /* few digits */
        if (trial == 1) below = 0;
        if (trial == 2) below = 1.7976931348623157e308;
        above = double_of(bits_of(below) + 1);
        put_middle(text, below, "");
        text_leads_to(text, bits_of(below) % 2 ? above : below);
        for (last = strchr(text, 'e') - 1; *last == '0';) *last-- = '9'; /* one less in the last place */
        --*last;
        text_leads_to(text, below);
        put_middle(text, below, "1");
        text_leads_to(text, above);
        put_middle(text, below, many);
        text_leads_to(text, above);
    }
}

/* 10^5 zeros, and an exponent that makes up for them. */
THEOREM(zeros_are_not_counted_as_digits)
{
    static char text[100100];
    double x = 0;
    memset(text, '0', sizeof text);
    memcpy(text, "0.", 2);
    strcpy(text + 100001, "125e100000");
    CHECK(parse_number(&powers, text, &x) && x == 1.25);
    CHECK(parse_number(NULL, text, &x) && x == 1.25);
    memset(text, '0', 100010);
    memcpy(text, "0000125", 7);
    strcpy(text + 100007, "e-100000");
    CHECK(parse_number(&powers, text, &x) && x == 125);
    CHECK(parse_number(NULL, text, &x) && x == 125);
    memset(text, '0', 100000);
    memcpy(text, "0x1.8", 5);
    strcpy(text + 100004, "p3");
    CHECK(parse_number(&powers, text, &x) && x == 12);
}

THEOREM(a_thousand_digits_count_wherever_the_point_is)
{
    static char text[1100];
    int exponent, leading;
    for (leading = '1'; leading <= '9'; leading += 4)
        for (exponent = -1410; exponent <= 400; exponent += 1 + (exponent < -1330 || exponent > -670 ? 0 : 40)) {
            memset(text, leading, 1000);
            sprintf(text + 1000, "e%d", exponent);
            is_read_as_by_strtod(&powers, text);
            if (exponent % 5 == 0) is_read_as_by_strtod(NULL, text);
        }
}

/* --- writing ------------------------------------------------------------------------------------------------------ */

THEOREM(numbers_are_written_as_printf_writes_them)
{
    static const double some[] = {0,
                                  1,
                                  -1,
                                  0.5,
                                  10,
                                  100,
                                  1e5,
                                  123456,
                                  1e16,
                                  1e17,
                                  1e18,
                                  1e22,
                                  1e23,
                                  1e100,
                                  1e-4,
                                  1e-5,
                                  0.1,
                                  9.9999e9,
                                  0.00012,
                                  99999.5,
                                  999999.5,
                                  9.5,
                                  0.095,
                                  0.00095,
                                  5e-324,
                                  1e-310,
                                  1e308,
                                  1.7976931348623157e308,
                                  2.2250738585072014e-308,
                                  2.5,
                                  3.5,
                                  12.5};
    chance c = {seed(1)};
    size_t i;
    int digits, trial;
    for (i = 0; i < sizeof some / sizeof *some; ++i)
        for (digits = 1; digits <= 17; ++digits) {
            is_written_as_by_printf(&powers, digits, some[i]);
            is_written_as_by_printf(NULL, digits, -some[i]);
        }
    is_written_as_by_printf(&powers, 17, -0.0);
    is_written_as_by_printf(&powers, 17, HUGE_VAL);
    is_written_as_by_printf(&powers, 17, -HUGE_VAL);
    for (trial = 0; trial < 60000; ++trial) {
        double x = any_double(&c);
        if (trial % 3 == 1) x = between(&c, -1, 1);
        is_written_as_by_printf(&powers, 17, x);
        is_written_as_by_printf(&powers, 1 + trial % 17, x);
        if (trial % 50 == 0) is_written_as_by_printf(NULL, 1 + trial % 17, x);
    }
}

/* Few binary digits behind the point: as many decimal ones, the last of which is 5. */
THEOREM(the_middle_between_two_texts_is_written_as_the_even_one)
{
    chance c = {seed(5)};
    int trial;
    for (trial = 0; trial < 20000; ++trial) {
        double x = floor(between(&c, 0, power_of_two(trial % 54))) * power_of_two(-trial / 54 % 24);
        is_written_as_by_printf(&powers, 1 + trial % 17, x);
        is_written_as_by_printf(&powers, 17, x);
    }
}

THEOREM(near_powers_of_ten_no_digit_is_lost_or_gained)
{
    int ten, step, digits;
    char text[32];
    double x;
    for (ten = -323; ten <= 308; ++ten) {
        sprintf(text, "1e%d", ten);
        x = strtod(text, NULL);
        for (step = -2; step <= 2; ++step)
            for (digits = 15; digits <= 17; ++digits)
                is_written_as_by_printf(&powers, digits, double_of(bits_of(x) + (uint64_t)(int64_t)step));
    }
}

/* --- the locale --------------------------------------------------------------------------------------------------- */

/* Where no locale has a decimal comma, there is nothing to prove. */
THEOREM(a_decimal_comma_of_the_locale_does_not_matter)
{
    static const char *const name[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "fr_FR", "German"};
    char text[64];
    double x = 0;
    size_t i;
    for (i = 0; i < sizeof name / sizeof *name; ++i)
        if (setlocale(LC_ALL, name[i])) break;
    CHECK(parse_number(&powers, "1.5", &x) && x == 1.5);
    CHECK(parse_number(NULL, "1.5", &x) && x == 1.5);
    CHECK(parse_number(&powers, "0x1.8", &x) && x == 1.5);
    CHECK(!parse_number(&powers, "1,5", &x));
    *write_number(&powers, text, 17, 1.5) = '\0';
    CHECK(strcmp(text, "1.5") == 0);
    setlocale(LC_ALL, "C");
}

int main(void)
{
    prepare_powers(&powers);
    PROVE(every_notation_that_strtod_reads_is_read_and_no_other);
    PROVE(a_whole_text_is_a_number_or_it_is_none);
    PROVE(digits_lead_to_the_nearest_double);
    PROVE(what_printf_printed_with_17_digits_comes_back);
    PROVE(halfway_text_rounds_to_even_and_else_to_the_nearer_double);
    PROVE(zeros_are_not_counted_as_digits);
    PROVE(a_thousand_digits_count_wherever_the_point_is);
    PROVE(numbers_are_written_as_printf_writes_them);
    PROVE(the_middle_between_two_texts_is_written_as_the_even_one);
    PROVE(near_powers_of_ten_no_digit_is_lost_or_gained);
    PROVE(a_decimal_comma_of_the_locale_does_not_matter);
    return QED();
}

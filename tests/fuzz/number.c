/* number.c - fuzzes examples/command/number.h against the C library: text to double, double to text, the same with and
   without the table of powers. */
#include "fuzz.h"

#include "examples/command/number.h"

static powers_of_ten powers;

static int same_double(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b) && !signbit(a) == !signbit(b));
}

static void claim_reading(const powers_of_ten *with, const char *text)
{
    double ours = -7, theirs;
    const char *end = read_number(with, text, &ours);
    char *their_end;
    theirs = strtod(text, &their_end);
    if (!end) {
        CLAIM(their_end == text && ours == -7);
        return;
    }
    CLAIM(end == their_end && same_double(ours, theirs));
    CLAIM(parse_number(with, text, &ours) == (*their_end == '\0'));
}

static void read_text(const char *text)
{
    claim_reading(&powers, text);
    claim_reading(NULL, text);
}

/* All 17 digits come back as what they were. */
static void write_value(double value, int digits)
{
    char ours[32], theirs[64], exact[32];
    double back;
    memset(ours, '~', sizeof ours);
    *write_number(&powers, ours, digits, value) = '\0';
    snprintf(theirs, sizeof theirs, "%.*g", digits, value);
    CLAIM(strlen(ours) <= 24 && ours[31] == '~' && strcmp(ours, theirs) == 0);
    *write_number(NULL, exact, digits, value) = '\0';
    CLAIM(strcmp(ours, exact) == 0);
    *write_number(&powers, ours, 17, value) = '\0';
    CLAIM(parse_number(&powers, ours, &back) && same_double(back, value));
}

/* What lies in the middle between two doubles, to its last digit, and what is a little beside it. */
static void read_middle(double value, bytes *in)
{
#if LDBL_MANT_DIG > DBL_MANT_DIG
    static char text[1300];
    long double middle = ((long double)value + (long double)nextafter(value, HUGE_VAL)) / 2;
    size_t at;
    if (!isfinite(value) || !isfinite(nextafter(value, HUGE_VAL))) return;
    snprintf(text, sizeof text, "%.*Le", (int)(take(in) * 4), middle);
    read_text(text);
    at = take(in) * 4;
    if (at >= strcspn(text, "e") || text[at] < '0' || text[at] > '8') return;
    ++text[at];
    read_text(text);
#else
    (void)value;
    (void)in;
#endif
}

static void fuzz(bytes in)
{
    static char text[4097];
    double value;
    int digits;
    size_t size;
    if (!powers.of[0].high) prepare_powers(&powers);
    if (take(&in) % 4 == 0) {
        value = take_number(&in);
        digits = 1 + (int)(take(&in) % 17);
        write_value(value, digits);
        read_middle(value, &in);
        return;
    }
    size = in.left < sizeof text - 1 ? in.left : sizeof text - 1;
    if (size > 0) memcpy(text, in.at, size);
    text[size] = '\0';
    read_text(text);
}

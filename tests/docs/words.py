"""Words that the project does not use, for the tests of documents, output and source code."""
import re

# In text: the word, and what the project says in its place.
OLD_WORDS = (
    (r"looks", "view, observation, or a verb such as appears"),
    (r"(?:an?|the|one|two|last|first|each|every|per|of) look", "view, observation"),
    (r"ways", "trajectories"),
    (r"(?:its|his|their) way", "trajectory, direction of motion"),
    (r"things?", "object, component, or its name"),
    (r"no name|without a name|what has no", "unknown class"),
    (r"rims?", "boundary"),
    (r"slack", "annealed scale"),
    (r"middle", "center"),
    (r"trunks?", "torso, backbone"),
    (r"written down", "recorded"),
    (r"off the truth", "error"),
    (r"told", "estimated, known, given"),
    (r"by heart", "overfit"),
    (r"at once", "immediately, live, simultaneously"),
    (r"true objects?", "ground-truth objects"),
    (r"identity F1", "IDF1"),
    (r"ms a (?:frame|picture)", "ms/frame, ms/image"),
    (r"99 % within", "p99"),
    (r"people's points", "person point recall"),
    (r"on nothing", "false positives"),
    (r"strangers?", "new objects"),
    (r"raggedness", "boundary jitter"),
    (r"rides?|ridden", "trajectory"),
    (r"residues?", "ghost points"),
    (r"trustworthy", "valid"),
    (r"(?<!ID )switches", "ID switches"),
    (r"cut_sigma|loose_sigma|max_shown|weight_bytes|mask_enlargement|nearest_seed",
     "the present name"),
)
OLD_METRICS = re.compile(r"\|\s*(found|extra|switches|turns)\s*\|")
# Correct uses of such words.
ALLOWED = re.compile(r"(?i)\b(?:two ways|both ways|SAC switches)\b")

# In source code: former identifiers.
OLD_NAMES = (
    "end_look", "ViewMemory", "kBlank", "leave_out", "TurnDelays", "LostTracks", "FloorWatch",
    "looks_ratio", "take_name", "let_go", "is_told", "kPrompt", "mask_enlargement",
    "weight_bytes", "weight_growth", "nearest_seed", r"k(?:Least|Most|Fewest|Farthest)\w*",
)


def check_words(name, lines, faults):
    """`lines`: (line number, text)."""
    for number, line in lines:
        line = ALLOWED.sub("", line)
        for pattern, better in OLD_WORDS:
            for match in re.finditer(r"(?i)(?<![\w-])(?:" + pattern + r")(?![\w-])", line):
                faults.append(f"{name}:{number}: '{match[0]}': say {better}")
        if match := OLD_METRICS.search(line):
            faults.append(f"{name}:{number}: '{match[1]}' is a former name of a metric")


def check_names(name, lines, faults):
    """Former identifiers in code; `lines`: (line number, text)."""
    for number, line in lines:
        for match in re.finditer(r"(?<!\w)(?:" + "|".join(OLD_NAMES) + r")(?!\w)", line):
            faults.append(f"{name}:{number}: '{match[0]}' is a former name")

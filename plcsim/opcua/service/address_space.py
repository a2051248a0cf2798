"""Makes the nodes of the controller in asyncua's address space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from asyncua import ua
from asyncua.common.structures104 import new_enum

from plcsim.opcua.model import Branch
from plcsim.opcua.service.values import VariableCodec
from st_types.types.derived import EnumerationType
from st_types.types.elementary import DINT

if TYPE_CHECKING:
    from collections.abc import Iterable

    from asyncua import Server

    from plcsim.opcua.model import Leaf

NAMESPACE: Final = "urn:plcsim:{project}"

_COMPONENT: Final = ua.NodeId(ua.ObjectIds.HasComponent)
_PROPERTY: Final = ua.NodeId(ua.ObjectIds.HasProperty)
_OBJECT: Final = ua.NodeId(ua.ObjectIds.BaseObjectType)
_VARIABLE: Final = ua.NodeId(ua.ObjectIds.BaseDataVariableType)
_ANALOG: Final = ua.NodeId(ua.ObjectIds.AnalogItemType)
_UNIT_NAMESPACE: Final = "http://www.opcfoundation.org/UA/units/un/cefact"


class Nodes:
    """The nodes of a controller.

    Args:
        server: asyncua's, initialised.
        project: names the namespace.

    Attributes:
        index: of the namespace.
        codecs: of the variables, by node.
    """

    def __init__(self, server: Server, project: str) -> None:
        self._server = server
        self._project = project
        self.index = 0
        self.codecs: dict[ua.NodeId, VariableCodec] = {}
        self._enumerations: dict[str, ua.NodeId] = {}
        self._items: dict[ua.NodeId, ua.AddNodesItem] = {}

    async def make(self, branches: Iterable[Branch]) -> None:
        """Make all nodes, below one object with the project's name."""
        self.index = await self._server.register_namespace(NAMESPACE.format(project=self._project))
        top = Branch(self._project, "::", "", list(branches))
        await self._object(self._server.nodes.objects.nodeid, top)

    async def _object(self, parent: ua.NodeId, branch: Branch) -> None:
        item = self._item(parent, branch.path, branch.name)
        item.NodeClass = ua.NodeClass.Object
        item.TypeDefinition = _OBJECT
        attributes = ua.ObjectAttributes()
        attributes.DisplayName = ua.LocalizedText(branch.name)
        attributes.Description = ua.LocalizedText(branch.type_name or branch.name)
        item.NodeAttributes = attributes
        self._add(item)
        for child in branch.children:
            if isinstance(child, Branch):
                await self._object(item.RequestedNewNodeId, child)
            else:
                await self._variable(item.RequestedNewNodeId, child)

    async def _variable(self, parent: ua.NodeId, leaf: Leaf) -> None:
        codec = VariableCodec(leaf)
        note = leaf.note
        item = self._item(parent, leaf.tag.path, leaf.name)
        item.NodeClass = ua.NodeClass.Variable
        is_analog = bool(note.unit) or None not in (note.minimum, note.maximum)
        item.TypeDefinition = _ANALOG if is_analog else _VARIABLE
        attributes = ua.VariableAttributes()
        attributes.DisplayName = ua.LocalizedText(leaf.name)
        attributes.Description = ua.LocalizedText(note.description or leaf.tag.data_type.name)
        attributes.DataType = await self._data_type(codec)
        attributes.ValueRank = len(leaf.dimensions) or ua.ValueRank.Scalar
        attributes.ArrayDimensions = list(leaf.dimensions) or None
        access = {ua.AccessLevel.CurrentRead}
        if leaf.is_writable:
            access.add(ua.AccessLevel.CurrentWrite)
        mask = sum(level.mask for level in access)
        attributes.AccessLevel = attributes.UserAccessLevel = mask
        attributes.Historizing = False
        attributes.MinimumSamplingInterval = 0.0
        attributes.Value = codec.variant(bytes(leaf.tag.data_type.size))
        item.NodeAttributes = attributes
        self._add(item)
        self.codecs[item.RequestedNewNodeId] = codec
        if is_analog:
            self._properties(item.RequestedNewNodeId, leaf)

    def _properties(self, parent: ua.NodeId, leaf: Leaf) -> None:
        """Give unit and range of the tag map (OPC 10000-8, 5.3.2.3)."""
        note = leaf.note
        if note.minimum is not None and note.maximum is not None:
            value: Any = ua.Range(note.minimum, note.maximum)
            self._property(parent, leaf, "EURange", value, ua.ObjectIds.Range)
        if note.unit:
            value = ua.EUInformation(
                NamespaceUri=_UNIT_NAMESPACE,
                UnitId=-1,
                DisplayName=ua.LocalizedText(note.unit),
                Description=ua.LocalizedText(note.unit),
            )
            self._property(parent, leaf, "EngineeringUnits", value, ua.ObjectIds.EUInformation)

    def _property(
        self, parent: ua.NodeId, leaf: Leaf, name: str, value: Any, data_type: int
    ) -> None:
        item = ua.AddNodesItem()
        item.RequestedNewNodeId = ua.NodeId(f"{leaf.tag.path}.{name}", self.index)
        item.BrowseName = ua.QualifiedName(name, 0)
        item.ParentNodeId = parent
        item.ReferenceTypeId = _PROPERTY
        item.NodeClass = ua.NodeClass.Variable
        item.TypeDefinition = ua.NodeId(ua.ObjectIds.PropertyType)
        attributes = ua.VariableAttributes()
        attributes.DisplayName = ua.LocalizedText(name)
        attributes.DataType = ua.NodeId(data_type)
        attributes.ValueRank = ua.ValueRank.Scalar
        attributes.AccessLevel = attributes.UserAccessLevel = ua.AccessLevel.CurrentRead.mask
        attributes.Value = ua.Variant(value)
        item.NodeAttributes = attributes
        self._add(item)

    async def _data_type(self, codec: VariableCodec) -> ua.NodeId:
        element = codec.leaf.element
        if not isinstance(element, EnumerationType) or element.base is not DINT:
            return codec.builtin.data_type
        if element.name not in self._enumerations:
            fields: list[str | ua.EnumField] = [
                ua.EnumField(Name=name, DisplayName=ua.LocalizedText(name), Value=value)
                for name, value in element.values.items()
            ]
            node = await new_enum(self._server, self.index, element.name, fields)
            for each, value in zip(fields, element.values.values(), strict=True):
                assert isinstance(each, ua.EnumField)
                each.Value = value  # new_enum counts from 0, whatever was given
            definition = ua.EnumDefinition()
            definition.Fields = fields
            await node.write_data_type_definition(definition)
            self._enumerations[element.name] = node.nodeid
        return self._enumerations[element.name]

    def _item(self, parent: ua.NodeId, path: str, name: str) -> ua.AddNodesItem:
        item = ua.AddNodesItem()
        item.RequestedNewNodeId = ua.NodeId(path, self.index)
        item.BrowseName = ua.QualifiedName(name, self.index)
        item.ParentNodeId = parent
        item.ReferenceTypeId = _COMPONENT
        return item

    def _add(self, item: ua.AddNodesItem) -> None:
        """Add a node, and tie it to its parent.

        asyncua itself compares each child with all before it: seconds where there are thousands.
        """
        parent, item.ParentNodeId = item.ParentNodeId, ua.NodeId()
        service = self._server.iserver.node_mgt_service
        for refused in service.try_add_nodes([item], check=False):
            raise ValueError(f"node {refused.RequestedNewNodeId} cannot be added")
        space = self._server.iserver.aspace
        space[parent].references.append(_reference(item, item, is_forward=True))
        if parent in self._items:
            upwards = _reference(self._items[parent], item, is_forward=False)
            space[item.RequestedNewNodeId].references.append(upwards)
        self._items[item.RequestedNewNodeId] = item


def _reference(
    target: ua.AddNodesItem, child: ua.AddNodesItem, *, is_forward: bool
) -> ua.ReferenceDescription:
    """Return how one end of a reference is described at the other.

    Args:
        target: the node at the end that is described.
        child: the node of the two that is below; it says what kind of reference it is.
        is_forward: the target is the child.
    """
    return ua.ReferenceDescription(
        ReferenceTypeId=child.ReferenceTypeId,
        IsForward=is_forward,
        NodeId=target.RequestedNewNodeId,
        BrowseName=target.BrowseName,
        DisplayName=target.NodeAttributes.DisplayName,
        NodeClass=target.NodeClass,
        TypeDefinition=target.TypeDefinition,
    )
